// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/grids/theta_search.h"

#include <algorithm>
#include <cmath>

#include "planning/grids/grid_directions.h"
#include "planning/grids/line_cost.h"

namespace trident::nav {
namespace {

/// Keys of the queue are costs in these parts of the lowest step cost.
constexpr double kKeysPerStep = 64.0;
/// Differences below this are those of rounding.
constexpr double kSame = 1e-5;

}  // namespace

ThetaSearch::ThetaSearch(const StepCosts& costs, int corners)
    : costs_(costs), corners_(corners), least_(costs.least()) {}

void ThetaSearch::begin(const CostGrid& grid, Cell start, Cell goal) {
  grid_ = grid;
  start_ = start;
  goal_ = goal;
  path_.clear();
  if (nodes_.size() < grid.geometry.size()) nodes_.assign(grid.geometry.size(), Node{});
  if (++stamp_ == 0) {
    std::fill(nodes_.begin(), nodes_.end(), Node{});
    stamp_ = 1;
  }
  queue_.reset(0, 4);
}

ThetaSearch::Result ThetaSearch::search(const CostGrid& grid, Cell start, Cell goal, double bound,
                                        const CancelFlag& cancel) {
  begin(grid, start, goal);
  bound_ = bound;
  const auto root = static_cast<std::uint32_t>(grid.geometry.index(start));
  const auto target = static_cast<std::uint32_t>(grid.geometry.index(goal));
  offer(root, 0.0, root, true);
  for (unsigned count = 1; queue_.advance(); ++count) {
    if (count % 1024 == 0 && cancel.load(std::memory_order_relaxed)) return Result::kCanceled;
    const std::uint32_t i = queue_.pop();
    if (nodes_[i].closed || !settle(i)) continue;
    if (i == target) {
      cost_ = nodes_[i].g;
      trace();
      return Result::kFound;
    }
    expand(i);
  }
  return Result::kNotBetter;
}

Cell ThetaSearch::cell(std::uint32_t i) const {
  const auto width = static_cast<std::uint32_t>(grid_.geometry.width);
  return {static_cast<int>(i % width), static_cast<int>(i / width)};
}

double ThetaSearch::distance_cost(Cell a, Cell b) const {
  return least_ * std::hypot(a.x - b.x, a.y - b.y);
}

bool ThetaSearch::can_step(Cell from, int direction) const {
  const auto free = [&](int dx, int dy) {
    const Cell c{from.x + dx, from.y + dy};
    return grid_.geometry.contains(c) && !costs_.blocked(grid_.at(c));
  };
  const int dx = kDx[direction];
  const int dy = kDy[direction];
  return free(dx, dy) && (direction < 4 || (free(dx, 0) && free(0, dy)));
}

double ThetaSearch::step(Cell a, Cell b) const {
  const double length = a.x != b.x && a.y != b.y ? 1.41421356237309504880 : 1.0;
  return 0.5 * length * (costs_.step[grid_.at(a)] + costs_.step[grid_.at(b)]);
}

ThetaSearch::Node& ThetaSearch::node(std::uint32_t i) {
  Node& n = nodes_[i];
  if (n.stamp != stamp_) {
    n = Node{};
    n.g = StepCosts::kBlocked;
    n.stamp = stamp_;
  }
  return n;
}

void ThetaSearch::offer(std::uint32_t i, double g, std::uint32_t parent, bool checked) {
  Node& n = node(i);
  const double f = g + distance_cost(cell(i), goal_);
  if (n.closed || g >= n.g || f >= bound_) return;
  n.g = static_cast<float>(g);
  n.parent = parent;
  n.checked = checked;
  queue_.push(static_cast<std::uint64_t>(f / least_ * kKeysPerStep), i);
}

// Looks at the line to a cell. False: it costs more than was assumed; the cell is queued again.
bool ThetaSearch::settle(std::uint32_t i) {
  Node& n = nodes_[i];
  if (!n.checked) {
    const GridGeometry& g = grid_.geometry;
    const Cell c = cell(i);
    const double assumed = n.g;
    double best =
        nodes_[n.parent].g + line_cost(grid_, costs_, g.center(cell(n.parent)), g.center(c));
    std::uint32_t parent = n.parent;
    for (int d = 0; d < corners_; ++d) {
      if (!can_step(c, d)) continue;
      const Cell from{c.x + kDx[d], c.y + kDy[d]};
      const auto j = static_cast<std::uint32_t>(g.index(from));
      if (nodes_[j].stamp != stamp_ || !nodes_[j].closed) continue;
      const double other = nodes_[j].g + step(from, c);
      if (other < best - kSame * least_) {
        best = other;
        parent = j;
      }
    }
    n.g = StepCosts::kBlocked;
    if (best > assumed + kSame * least_) {
      offer(i, best, parent, true);
      return false;
    }
    n.g = static_cast<float>(best);
    n.parent = parent;
    n.checked = true;
  }
  n.closed = true;
  return true;
}

void ThetaSearch::expand(std::uint32_t i) {
  const Cell c = cell(i);
  const std::uint32_t parent = nodes_[i].parent;
  for (int d = 0; d < corners_; ++d) {
    if (!can_step(c, d)) continue;
    const Cell to{c.x + kDx[d], c.y + kDy[d]};
    const auto j = static_cast<std::uint32_t>(grid_.geometry.index(to));
    if (node(j).closed) continue;
    offer(j, nodes_[parent].g + distance_cost(cell(parent), to), parent, false);
  }
}

void ThetaSearch::trace() {
  auto i = static_cast<std::uint32_t>(grid_.geometry.index(goal_));
  path_.push_back(goal_);
  while (!(cell(i) == start_)) {
    i = nodes_[i].parent;
    path_.push_back(cell(i));
  }
  std::reverse(path_.begin(), path_.end());
}

}  // namespace trident::nav
