// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/grids/jump_points.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "planning/grids/grid_directions.h"

namespace trident::nav {
namespace {

int sign(int value) { return (value > 0) - (value < 0); }

unsigned bit(int direction) { return 1U << static_cast<unsigned>(direction); }

}  // namespace

JumpPoints::JumpPoints(const StepCosts& costs, bool outline) : costs_(costs), outline_(outline) {}

bool JumpPoints::read(const CostGrid& grid) {
  const bool is_known =
      map_.is_read && grid.revision == map_.revision && grid.geometry == map_.geometry;
  if (!is_known) {
    map_.geometry = grid.geometry;
    map_.revision = grid.revision;
    map_.is_uniform = read_costs(grid);
    map_.is_read = true;
  }
  return map_.is_uniform;
}

// The one step cost, if there is one; most costmaps show in their first rows that there is not.
std::optional<float> JumpPoints::uniform_step(const CostGrid& grid) const {
  float step = StepCosts::kBlocked;
  for (std::size_t i = 0; i < map_.geometry.size(); ++i) {
    const float cost = costs_.step[grid.cost[i]];
    if (cost == StepCosts::kBlocked) continue;
    if (step == StepCosts::kBlocked) step = cost;
    if (cost != step) return std::nullopt;
  }
  return step;
}

bool JumpPoints::is_on_outline(int x, int y) const {
  const int right = map_.geometry.width - 1, top = map_.geometry.height - 1;
  return outline_ && (x == 0 || y == 0 || x == right || y == top);
}

void JumpPoints::block_cells(const CostGrid& grid) {
  map_.rows.reset(map_.geometry.height, map_.geometry.width);
  map_.columns.reset(map_.geometry.width, map_.geometry.height);
  for (int y = 0; y < map_.geometry.height; ++y) {
    for (int x = 0; x < map_.geometry.width; ++x) {
      if (!is_on_outline(x, y) && !costs_.blocked(grid.at(Cell{x, y}))) continue;
      map_.rows.block(y, x);
      map_.columns.block(x, y);
    }
  }
}

// Whether there is one step cost; where there is not, nothing more is read.
bool JumpPoints::read_costs(const CostGrid& grid) {
  const std::optional<float> step = uniform_step(grid);
  if (!step) return false;
  map_.step = *step;
  block_cells(grid);
  tiles_x_ = map_.geometry.width / kTile + 1;
  forget_nodes();
  return true;
}

void JumpPoints::forget_nodes() {
  tiles_.clear();
  tiles_.resize(static_cast<std::size_t>(tiles_x_) *
                static_cast<std::size_t>(map_.geometry.height / kTile + 1));
  search_ = 0;
}

JumpPoints::Node& JumpPoints::node(Cell c) {
  const auto x = static_cast<unsigned>(c.x);
  const auto y = static_cast<unsigned>(c.y);
  auto& owner = tiles_[y / kTile * static_cast<unsigned>(tiles_x_) + x / kTile];
  if (owner == nullptr) owner = std::make_unique<Tile>();
  Node& found = (*owner)[y % kTile * kTile + x % kTile];
  if (found.search != search_) {
    found = Node{};
    found.search = search_;
  }
  return found;
}

// Octile distance in steps' lengths, never above the true one.
std::uint64_t JumpPoints::distance(Cell a, Cell b) {
  const auto dx = static_cast<std::uint64_t>(std::abs(a.x - b.x));
  const auto dy = static_cast<std::uint64_t>(std::abs(a.y - b.y));
  const std::uint64_t least = std::min(dx, dy);
  return kStraight * std::max(dx, dy) + (kSlanted - kStraight) * least;
}

SearchResult JumpPoints::search(Cell start, Cell goal, const CancelFlag& cancel) {
  if (++search_ == kMaxSearches) {
    forget_nodes();
    search_ = 1;
  }
  start_ = start;
  goal_ = goal;
  expanded_ = 0;
  node(start).length = 0;
  node(start).is_open = 1;
  Node& found = node(goal);
  queue_.reset(distance(start, goal), kBucketShift);
  queue_.push(distance(start, goal), start);
  while (queue_.advance() && queue_.lower_bound() < found.length) {
    if ((expanded_++ & 0xFFU) == 0 && cancel.load(std::memory_order_relaxed)) {
      return SearchResult::kCanceled;
    }
    const Cell c = queue_.pop();
    if (node(c).is_open) expand(c);
  }
  if (found.length == kUnreached) return SearchResult::kNoPath;
  path_ = trace();
  cost_ = cost_of(path_);
  return SearchResult::kFound;
}

// Where a shortest path may continue from a jump point: with diagonal steps first, straight steps
// turn only around the ends of obstacles.
void JumpPoints::expand(Cell c) {
  Node& at = node(c);
  at.is_open = 0;
  const auto direction = static_cast<int>(at.direction);
  const bool is_start = at.direction == kAnyDirection;
  unsigned left = is_start ? 0xFFU : bit(direction) | openings(c, direction);
  for (int d = 0; left != 0; ++d, left >>= 1U) {
    if ((left & 1U) != 0) jump(c, d);
  }
}

// The sides at which straight steps pass the end of an obstacle: to the side, and ahead of that.
unsigned JumpPoints::openings(Cell c, int direction) const {
  unsigned result = 0;
  for (const int side : {(direction + 1) % 4, (direction + 3) % 4}) {
    const int x =
        c.x + kDx[static_cast<std::size_t>(side)] - kDx[static_cast<std::size_t>(direction)];
    const int y =
        c.y + kDy[static_cast<std::size_t>(side)] - kDy[static_cast<std::size_t>(direction)];
    if (is_free(x, y)) continue;
    result |= bit(side) | bit(between(direction, side));
  }
  return result;
}

void JumpPoints::jump(Cell from, int direction) {
  if (direction < 4) {
    jump_straight(from, from, direction);
  } else {
    jump_diagonal(from, direction);
  }
}

// Offers the jump point along a straight line from a cell, which was reached from another.
void JumpPoints::jump_straight(Cell from, Cell via, int direction) {
  const bool is_row = direction % 2 == 0;
  const JumpScan& lines = is_row ? map_.rows : map_.columns;
  const int line = is_row ? via.y : via.x;
  const bool has_goal = line == (is_row ? goal_.y : goal_.x);
  const int goal_at = has_goal ? (is_row ? goal_.x : goal_.y) : JumpScan::kNone;
  const int at = lines.jump(line, is_row ? via.x : via.y, direction < 2 ? 1 : -1, goal_at);
  if (at == JumpScan::kNone) return;
  offer(from, is_row ? Cell{at, line} : Cell{line, at}, direction);
}

// All jump points to the two sides of a diagonal line.
void JumpPoints::jump_diagonal(Cell from, int direction) {
  const int dx = kDx[static_cast<std::size_t>(direction)];
  const int dy = kDy[static_cast<std::size_t>(direction)];
  const auto& sides = kCut[static_cast<std::size_t>(direction - 4)];
  Cell c = from;
  while (is_free(c.x + dx, c.y) && is_free(c.x, c.y + dy) && is_free(c.x + dx, c.y + dy)) {
    c = {c.x + dx, c.y + dy};
    if (c == goal_) {
      offer(from, c, sides[0]);
      return;
    }
    jump_straight(from, c, sides[0]);
    jump_straight(from, c, sides[1]);
  }
}

void JumpPoints::offer(Cell from, Cell to, int direction) {
  // A path too long for its number is left out: the caller has a search without this limit.
  const std::uint64_t length = node(from).length + distance(from, to);
  Node& at = node(to);
  if (length >= at.length) return;
  at.length = static_cast<std::uint32_t>(length);
  at.parent = static_cast<std::int32_t>(map_.geometry.index(from));
  at.direction = static_cast<unsigned>(direction) & 0xFU;
  at.is_open = 1;
  queue_.push(length + distance(to, goal_), to);
}

double JumpPoints::cost_of(const std::vector<Cell>& path) const {
  int straight = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    straight += path[i].x == path[i - 1].x || path[i].y == path[i - 1].y ? 1 : 0;
  }
  const int diagonal = static_cast<int>(path.size()) - 1 - straight;
  return (straight + kDiagonal * diagonal) * map_.step;
}

// From one jump point to the next a path goes diagonally first, then straight.
std::vector<Cell> JumpPoints::trace() {
  std::vector<Cell> jumps{goal_};
  while (!(jumps.back() == start_)) {
    const std::int32_t parent = node(jumps.back()).parent;
    jumps.push_back({parent % map_.geometry.width, parent / map_.geometry.width});
  }
  std::vector<Cell> cells{start_};
  for (auto to = jumps.rbegin(); to != jumps.rend(); ++to) {
    Cell c = cells.back();
    while (!(c == *to)) {
      c = {c.x + sign(to->x - c.x), c.y + sign(to->y - c.y)};
      cells.push_back(c);
    }
  }
  return cells;
}

}  // namespace trident::nav
