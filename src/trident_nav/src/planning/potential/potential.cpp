// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/potential/potential.h"

#include <cmath>

namespace trident::nav {

Potential::Potential(const StepCosts& costs, bool outline) : costs_(costs), cells_(outline) {}

bool Potential::is_kept(const CostGrid& grid, Cell goal_inside) const {
  return status_.is_ready && goal_inside == ends_.goal && grid.geometry == geometry_ &&
         !status_.is_too_long;
}

Potential::Result Potential::search(const CostGrid& grid, Cell goal, Cell start,
                                    const CancelFlag& cancel, Costs costs) {
  source_ = &grid;
  const Cell goal_inside{goal.x + 1, goal.y + 1};
  const Cell start_inside{start.x + 1, start.y + 1};
  const bool kept = is_kept(grid, goal_inside);
  expanded_.now = expanded_.dropped = 0;
  if (kept) {
    aim(start_inside);
  } else {
    scale_.coarser = 1.0;
    begin(goal_inside, start_inside);
  }
  if (kept) take_changes();
  Result result = run(cancel, costs);
  while (result == Result::kNoPath && status_.is_too_long && steps_.least_straight > 64) {
    scale_.coarser *= 16.0;
    begin(goal_inside, start_inside);
    result = run(cancel, costs);
  }
  revision_ = grid.revision;
  expanded_.total += expanded_.now;
  source_ = nullptr;
  return result;
}

std::uint32_t Potential::value(Cell c) const {
  if (!status_.is_ready || !geometry_.contains(c)) return kUnreached;
  const int x = c.x + 1;
  const int y = c.y + 1;
  return cells_.is_filled(x, y) ? cells_[cells_.index(x, y)].value : kUnreached;
}

float Potential::at(Cell c) const {
  const std::uint32_t v = value(c);
  return v == kUnreached ? StepCosts::kBlocked : static_cast<float>(v / scale_.value);
}

std::vector<Cell> Potential::trace() const {
  std::vector<Cell> cells;
  Cell c = ends_.start;
  while (true) {
    cells.push_back({c.x - 1, c.y - 1});
    const std::size_t parent = cells_[cells_.index(c.x, c.y)].parent;
    if (parent == kRoot) return cells;
    c = {c.x + kDx[parent], c.y + kDy[parent]};
  }
}

void Potential::begin(Cell goal, Cell start) {
  geometry_ = source_->geometry;
  cells_.reset(geometry_);
  ends_ = {goal, start};
  status_ = {true, false, false};
  expanded_.total = 0;
  lead_ = 0;
  choose_scale(scale_.coarser);
  unsigned shift = 0;
  while ((steps_.least_straight >> (shift + 3)) > 0) ++shift;
  queue_.reset(heuristic(goal.x, goal.y), shift);
  cells_.fill(goal.x, goal.y, *source_);
  Node& root = cells_[cells_.index(goal.x, goal.y)];
  root.value = 0;
  root.parent = kRoot;
  open(goal.x, goal.y, root);
}

// Whole numbers make equal sums equal, whatever their order: no cell is expanded again for the last
// bit. The scale leaves room for paths of twice the sum of the sides, at the lowest cost.
void Potential::choose_scale(double coarser) {
  const double least = costs_.least();
  const double longest = 2.0 * (geometry_.width + geometry_.height + 64.0) * least;
  scale_.value = std::exp2(std::floor(std::log2(kLimit / longest / coarser)));
  for (std::size_t c = 0; c < 256; ++c) {
    const double step = costs_.step[c] * scale_.value;
    const bool blocked = !(step < kLimit / 2.0);
    steps_.straight[c] = blocked ? kBlockedStep : static_cast<std::uint32_t>(std::lround(step));
    steps_.diagonal[c] =
        blocked ? kBlockedStep : static_cast<std::uint32_t>(std::lround(step * kDiagonal));
  }
  steps_.least_straight = static_cast<std::uint32_t>(std::lround(least * scale_.value));
  steps_.least_diagonal = static_cast<std::uint32_t>(std::lround(least * scale_.value * kDiagonal));
}

// Octile distance at the lowest step cost: never above the true cost, and consistent.
std::uint32_t Potential::distance(Cell a, Cell b) const {
  const auto dx = static_cast<std::uint32_t>(std::abs(a.x - b.x));
  const auto dy = static_cast<std::uint32_t>(std::abs(a.y - b.y));
  const std::uint32_t most = std::max(dx, dy);
  const std::uint32_t least = std::min(dx, dy);
  return steps_.least_straight * (most - least) + steps_.least_diagonal * least;
}

// What is in the queue stays there: its keys are too high by no more than the start has moved.
void Potential::aim(Cell start) {
  lead_ += distance(ends_.start, start);
  ends_.start = start;
}

// A path over cells that have become dearer is searched again, with what they cost now.
Potential::Result Potential::run(const CancelFlag& cancel, Costs costs) {
  Result result = run_on_known_costs(cancel);
  if (costs == Costs::kKnown) return result;
  while (result == Result::kFound && raise_under_path()) result = run_on_known_costs(cancel);
  return result;
}

Potential::Result Potential::run_on_known_costs(const CancelFlag& cancel) {
  cells_.fill(ends_.start.x, ends_.start.y, *source_);
  const std::uint32_t& found = cells_[cells_.index(ends_.start.x, ends_.start.y)].value;
  const std::uint64_t allowance = std::uint64_t{kAllowance} * steps_.least_straight;
  Cells later;
  Result result = Result::kFound;
  unsigned count = 0;
  while (queue_.advance() && queue_.lower_bound() < found + lead_) {
    prefetch(queue_.ahead(kPrefetch));
    const Packed p = queue_.pop();
    const Node& node = cells_[index(p)];
    if (!node.is_open) continue;
    const std::uint64_t now = key(x_of(p), y_of(p), node.value);
    if (now >= found + lead_) {
      later.push_back(p);
      continue;
    }
    if (queue_.is_later(now)) {
      queue_.push(now, p);
      continue;
    }
    expand_run(p, std::min(queue_.lower_bound() + allowance, found + lead_));
    if ((++count & 0x3FFU) == 0 && cancel.load(std::memory_order_relaxed)) {
      result = Result::kCanceled;
      break;
    }
  }
  for (const Packed p : later) queue_.push(key(x_of(p), y_of(p), cells_[index(p)].value), p);
  if (result == Result::kFound && found == kUnreached) result = Result::kNoPath;
  return result;
}

// Cells of a bucket lie far apart: what they need is fetched while others are expanded.
void Potential::prefetch(Packed p) const {
  const Node* node = &cells_[index(p)];
  __builtin_prefetch(node);
  __builtin_prefetch(node - PotentialCells::kSide);
  __builtin_prefetch(node + PotentialCells::kSide);
}

Potential::Around Potential::around(int x, int y) {
  cells_.fill_around(x, y, *source_);
  return {&cells_[cells_.index(x, y)], x, y, &cells_.offsets(x, y)};
}

// Continues straight ahead without the queue as long as keys stay below the limit: what comes next
// is at hand, and most of it would be expanded soon.
void Potential::expand_run(Packed p, std::uint64_t limit) {
  Around at = around(x_of(p), y_of(p));
  while (true) {
    at.node->is_open = false;
    ++expanded_.now;
    const int parent = at.node->parent;
    if (parent == kRoot) {
      expand_all(at);
      return;
    }
    const int arrival = opposite(parent);
    const bool is_ahead_free =
        parent < 4 ? expand_straight(at, arrival) : expand_diagonal(at, arrival);
    if (!is_ahead_free || !advance(at, arrival, limit)) return;
  }
}

// Moves to the next cell if that lowers its value; false when there is nothing to be expanded now.
bool Potential::advance(Around& at, int direction, std::uint64_t limit) {
  Node* node = &at.next(direction);
  const std::uint32_t length = direction < 4 ? straight(node->cost) : diagonal(node->cost);
  const std::uint32_t v = at.node->value + length;
  if (v >= node->value) return false;
  const Packed p = at.packed(direction);
  const std::uint64_t next_key = key(x_of(p), y_of(p), v);
  if (next_key >= limit || v >= kLimit) {
    set(*node, v, opposite(direction), p);
    return false;
  }
  node->value = v;
  node->parent = static_cast<std::uint8_t>(opposite(direction));
  cells_.fill_around(x_of(p), y_of(p), *source_);
  at = {node, x_of(p), y_of(p), &cells_.offsets(x_of(p), y_of(p))};
  return true;
}

// After a straight step: the three cells ahead, and those at the sides, unless the predecessor
// reaches them as cheaply by a diagonal step to the side. Where all costs are equal only the one
// straight ahead is left. Returns whether that can be entered; it is not relaxed here.
bool Potential::expand_straight(const Around& at, int arrival) {
  if (at.node->is_even) return true;
  const std::uint32_t own = straight(at.node->cost);
  const std::uint8_t ahead = at.cost(arrival);
  const bool is_ahead_free = !is_blocked(ahead);
  for (const int side : {(arrival + 1) % 4, (arrival + 3) % 4}) {
    const std::uint8_t lateral = at.cost(side);
    if (is_blocked(lateral)) continue;
    const bool can_pass = !is_blocked(at.cost(between(opposite(arrival), side)));
    const std::uint32_t past = diagonal(lateral);  // From the predecessor to the side.
    if (!can_pass || past >= own + straight(lateral)) relax(at, side, straight(lateral));
    const int slanted = between(arrival, side);
    const std::uint8_t corner = at.cost(slanted);
    if (!is_ahead_free || is_blocked(corner)) continue;
    if (can_pass && past + straight(corner) <= own + diagonal(corner)) continue;
    relax(at, slanted, diagonal(corner));
  }
  return is_ahead_free;
}

// After a diagonal step: the three cells ahead, and those beyond the two cells that it passed
// between, unless two straight steps over one of these reach them for less. Returns whether the one
// straight ahead can be entered; it is not relaxed here.
bool Potential::expand_diagonal(const Around& at, int arrival) {
  const auto& sides = kCut[static_cast<std::size_t>(arrival - 4)];
  if (at.node->is_even) {
    relax(at, sides[0], straight(at.node->cost));
    relax(at, sides[1], straight(at.node->cost));
    return true;
  }
  const std::uint32_t own = diagonal(at.node->cost);
  std::array<bool, 2> is_free{};
  for (std::size_t k = 0; k < 2; ++k) {
    const int side = sides[k];
    const std::uint8_t lateral = at.cost(side);
    is_free[k] = !is_blocked(lateral);
    if (!is_free[k]) continue;
    const int back = opposite(sides[1 - k]);
    const int slanted = between(side, back);
    const std::uint8_t corner = at.cost(slanted);
    if (!is_blocked(corner) &&
        straight(at.cost(back)) + straight(corner) >= own + diagonal(corner)) {
      relax(at, slanted, diagonal(corner));
    }
    relax(at, side, straight(lateral));
  }
  return is_free[0] && is_free[1] && !is_blocked(at.cost(arrival));
}

void Potential::expand_all(const Around& at) {
  std::array<bool, 4> free{};
  for (int d = 0; d < 4; ++d) {
    const std::uint8_t cost = at.cost(d);
    free[static_cast<std::size_t>(d)] = !is_blocked(cost);
    if (!is_blocked(cost)) relax(at, d, straight(cost));
  }
  for (int d = 4; d < 8; ++d) {
    const std::uint8_t cost = at.cost(d);
    if (can_cut(free, d) && !is_blocked(cost)) relax(at, d, diagonal(cost));
  }
}

void Potential::relax(const Around& from, int direction, std::uint32_t length) {
  Node& node = from.next(direction);
  const std::uint32_t v = from.node->value + length;
  if (v < node.value) set(node, v, opposite(direction), from.packed(direction));
}

void Potential::set(Node& node, std::uint32_t value, int parent, Packed p) {
  if (value >= kLimit) {
    status_.is_too_long = true;
    return;
  }
  node.value = value;
  node.parent = static_cast<std::uint8_t>(parent);
  open(x_of(p), y_of(p), node);
}

void Potential::open(int x, int y, Node& node) {
  node.is_open = true;
  queue_.push(key(x, y, node.value), pack(x, y));
}

}  // namespace trident::nav
