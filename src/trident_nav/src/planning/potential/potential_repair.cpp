// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// How a kept potential follows changes of the costs. The costs that it knows are never above those
// of the grid: cheaper ones are taken at once, dearer ones when the start's path leads over them.
// Then the path's cost is that in the grid, and no other path of the grid costs less.
//
// After each change every value is the cost of a real path by the known costs, and every cell that
// could lower a neighbor is open: then continuing the search makes the start's value exact. Since
// an expansion leaves out what it could see to be in vain from the costs around it, cells next to a
// changed one are opened again.
#include "planning/potential/potential.h"

#include <algorithm>
#include <optional>

namespace trident::nav {

void Potential::take_changes() {
  const std::uint64_t now = source_->revision;
  if (now != 0 && now == revision_) return;
  const std::uint64_t since = now > revision_ ? revision_ : 0;  // else of another origin
  Cells cheaper;
  cells_.for_each_difference(*source_, since, [&](int x, int y) {
    const std::uint32_t known = straight(cells_[cells_.index(x, y)].cost);
    const std::uint32_t cost = straight(cells_.cost_in(*source_, x, y));
    if (cost < known) cheaper.push_back(pack(x, y));
    status_.has_dearer |= cost > known;
  });
  take_costs(cheaper);
}

// Takes the grid's costs of cells, after their values have been dropped if they are dearer.
void Potential::take_costs(const Cells& cells) {
  for (const Packed p : cells) {
    cells_.set_cost(x_of(p), y_of(p), cells_.cost_in(*source_, x_of(p), y_of(p)));
  }
  for (const Packed p : cells) offer_from_neighbors(p);
  for (const Packed p : cells) reopen_around(p);
}

bool Potential::is_dearer_at(const CostGrid& grid, int x, int y) const {
  const std::uint8_t known = cells_[cells_.index(x, y)].cost;
  return straight(cells_.cost_in(grid, x, y)) > straight(known);
}

bool Potential::is_dearer(const CostGrid& grid, Cell from, Cell to) const {
  const Cell a{from.x + 1, from.y + 1};
  const Cell b{to.x + 1, to.y + 1};
  return is_dearer_at(grid, a.x, a.y) || is_dearer_at(grid, a.x, b.y) ||
         is_dearer_at(grid, b.x, a.y);
}

// Takes the dearer costs about those cells of the start's path, and next to its diagonal steps,
// that are dearer than is known. False: no cell is, and the path is right.
bool Potential::raise_under_path() {
  if (!status_.has_dearer) return false;
  bool has_raised = false;
  const std::vector<Cell> path = trace();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (!is_dearer(*source_, path[i], path[i + 1])) continue;
    has_raised = true;
    if (raise_about({path[i].x + 1, path[i].y + 1})) continue;
    begin(ends_.goal, ends_.start);
    break;
  }
  return has_raised;
}

// False: so much lost its support that a new search is cheaper.
bool Potential::raise_about(Cell c) {
  Cells dearer;
  cells_.for_each_difference_near(c.x, c.y, *source_, [&](int x, int y) {
    if (is_dearer_at(*source_, x, y)) dearer.push_back(pack(x, y));
  });
  Cells invalid;
  if (!invalidate(dearer, invalid)) return false;
  take_costs(dearer);
  for (const Packed p : invalid) offer_from_neighbors(p);
  return true;
}

// Unreaches all cells whose path to the goal contains a step that became dearer or impossible.
bool Potential::invalidate(const Cells& dearer, Cells& invalid) {
  const std::size_t limit = expanded_.total / 4 + 4096;
  Cells stack;
  for (const Packed p : dearer) {
    seed_invalid(p, stack);
    while (!stack.empty()) {
      const Packed top = stack.back();
      stack.pop_back();
      const Node& node = cells_[index(top)];
      if (node.value == kUnreached || node.parent == kRoot) continue;
      drop(top, stack);
      invalid.push_back(top);
      if (++expanded_.dropped > limit) return false;
    }
  }
  return true;
}

// A cell, and the neighbors that step diagonally past it.
void Potential::seed_invalid(Packed p, Cells& stack) {
  stack.push_back(p);
  if (!is_blocked(cells_.cost_in(*source_, x_of(p), y_of(p)))) return;
  const Around at = around(x_of(p), y_of(p));
  for (int d = 0; d < 4; ++d) {
    const Node& node = at.next(d);
    if (node.value == kUnreached || node.parent < 4 || node.parent == kRoot) continue;
    const auto& cut = kCut[node.parent - 4U];
    if (cut[0] == opposite(d) || cut[1] == opposite(d)) stack.push_back(at.packed(d));
  }
}

void Potential::drop(Packed p, Cells& stack) {
  const Around at = around(x_of(p), y_of(p));
  at.node->value = kUnreached;
  at.node->parent = PotentialCells::kNoParent;
  at.node->is_open = false;
  for (int d = 0; d < 8; ++d) {
    if (at.next(d).parent == opposite(d)) stack.push_back(at.packed(d));
  }
}

// Lowers the value of a cell to the best that its neighbors offer.
void Potential::offer_from_neighbors(Packed p) {
  const Around at = around(x_of(p), y_of(p));
  if (is_blocked(at.node->cost) || at.node->parent == kRoot) return;
  std::array<bool, 4> free{};
  std::uint32_t best = at.node->value;
  int parent = PotentialCells::kNoParent;
  for (int d = 0; d < 8; ++d) {
    const Node& node = at.next(d);
    if (d < 4) free[static_cast<std::size_t>(d)] = !is_blocked(node.cost);
    if (d >= 4 && !can_cut(free, d)) continue;
    if (node.value == kUnreached) continue;
    const std::uint32_t v =
        node.value + (d < 4 ? straight(at.node->cost) : diagonal(at.node->cost));
    if (v >= best) continue;
    best = v;
    parent = d;
  }
  if (parent != PotentialCells::kNoParent) set(*at.node, best, parent, p);
}

// What a cell's costs had an influence on may be expanded otherwise now.
void Potential::reopen_around(Packed p) {
  const Around at = around(x_of(p), y_of(p));
  const auto reopen = [this](Node& node, Packed q) {
    if (node.value != kUnreached && !node.is_open) open(x_of(q), y_of(q), node);
  };
  reopen(*at.node, p);
  for (int d = 0; d < 8; ++d) reopen(at.next(d), at.packed(d));
}

// A path by known costs from a cell that is not done leads over an open one, whose key is not below
// the start's value; a cell's value that with the distance to the start is not above it is exact.
Potential::Bound Potential::bound(Cell c) const {
  const Cell at{c.x + 1, c.y + 1};
  const std::uint32_t found = value(start());
  const std::uint32_t least = found - std::min(found, distance(at, ends_.start));
  const std::uint32_t known = value(c);
  if (known <= least) return {known, true};
  return {std::max(least, distance(at, ends_.goal)), false};
}

std::optional<Cell> Potential::next(Cell c) const {
  const std::size_t parent = cells_[cells_.index(c.x + 1, c.y + 1)].parent;
  if (parent == kRoot) return std::nullopt;
  return Cell{c.x + kDx[parent], c.y + kDy[parent]};
}

}  // namespace trident::nav
