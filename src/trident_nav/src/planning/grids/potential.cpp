// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/grids/potential.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "planning/grids/grid_directions.h"

namespace trident::nav {

Potential::Potential(const StepCosts& costs, bool outline) : costs_(costs), outline_(outline) {}

Potential::Result Potential::search(const CostGrid& grid, Cell goal, Cell start,
                                    const CancelFlag& cancel) {
  source_ = &grid;
  const Cell goal_inside{goal.x + 1, goal.y + 1};
  const bool kept = status_.is_ready && goal_inside == ends_.goal && grid.geometry == geometry_ &&
                    !status_.is_too_long;
  if (!kept) {
    scale_.coarser = 1.0;
    begin(grid, goal_inside);
  }
  expanded_.now = 0;
  aim({start.x + 1, start.y + 1});
  if (kept && !repair()) {
    begin(grid, goal_inside);
    aim({start.x + 1, start.y + 1});
  }
  Result result = run(cancel);
  while (result == Result::kNoPath && status_.is_too_long && steps_.least_straight > 64) {
    scale_.coarser *= 16.0;
    begin(grid, goal_inside);
    aim({start.x + 1, start.y + 1});
    result = run(cancel);
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
  const int number = (y / kTile) * tiles_.x + x / kTile;
  const auto tile = static_cast<std::size_t>(number);
  return tiles_.state[tile] == TileState::kUnused ? kUnreached : cells_.value[index(x, y)];
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
    const int parent = cells_.state[index(c.x, c.y)] & 0x0F;
    if (parent == kRoot) return cells;
    c = {c.x + kDx[parent], c.y + kDy[parent]};
  }
}

void Potential::allocate(const GridGeometry& geometry) {
  const int width = geometry.width + 2;
  const int height = geometry.height + 2;
  tiles_.x = (width + kTile - 1) / kTile;
  tiles_.y = (height + kTile - 1) / kTile;
  stride_ = static_cast<std::size_t>(tiles_.x) * kTile;
  const std::size_t needed = stride_ * static_cast<std::size_t>(tiles_.y) * kTile;
  if (needed > cells_.allocated) {
    // Not initialized: a tile is filled when a search comes to it.
    cells_.value.reset(new std::uint32_t[needed]);
    cells_.cost.reset(new std::uint8_t[needed]);
    cells_.state.reset(new std::uint8_t[needed]);
    cells_.allocated = needed;
  }
  const auto stride = static_cast<std::ptrdiff_t>(stride_);
  for (std::size_t d = 0; d < 8; ++d) offset_[d] = kDy[d] * stride + kDx[d];
  geometry_ = geometry;
}

void Potential::begin(const CostGrid& grid, Cell goal) {
  allocate(grid.geometry);
  tiles_.state.assign(static_cast<std::size_t>(tiles_.x) * static_cast<std::size_t>(tiles_.y),
                      TileState::kUnused);
  ends_.goal = ends_.start = goal;
  status_.is_too_long = false;
  expanded_.total = 0;
  status_.is_ready = true;
  choose_scale(scale_.coarser);
  queue_.reset(0, 0);
  fill_tile(goal.x / kTile, goal.y / kTile);
  const std::size_t root = index(goal.x, goal.y);
  cells_.value[root] = 0;
  cells_.state[root] = kRoot | kOpen;
  queue_.push(0, pack(goal.x, goal.y));
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

std::uint8_t Potential::source_cost(int x, int y) const {
  const int low = outline_ ? 2 : 1;
  const int high = outline_ ? 1 : 0;
  const bool inside =
      x >= low && y >= low && x <= geometry_.width - high && y <= geometry_.height - high;
  return inside ? source_->at(Cell{x - 1, y - 1}) : kLethalCost;
}

void Potential::fill_tile(int tile_x, int tile_y) {
  const int number = tile_y * tiles_.x + tile_x;
  TileState& tile = tiles_.state[static_cast<std::size_t>(number)];
  if (tile != TileState::kUnused) return;
  tile = TileState::kFilled;
  const int x0 = tile_x * kTile;
  const int low = outline_ ? 2 : 1;
  const int from = std::max(x0, low);
  const int to = std::min(x0 + kTile, geometry_.width + 1 - (low - 1));
  for (int y = tile_y * kTile; y < (tile_y + 1) * kTile; ++y) {
    const std::size_t row = index(x0, y);
    std::fill_n(&cells_.value[row], kTile, kUnreached);
    std::memset(&cells_.state[row], 0, kTile);
    std::memset(&cells_.cost[row], kLethalCost, kTile);
    if (y < low || y > geometry_.height - (low - 1) || from >= to) continue;
    std::memcpy(&cells_.cost[index(from, y)], source_->cost + geometry_.index({from - 1, y - 1}),
                static_cast<std::size_t>(to - from));
  }
}

// Fills the tiles around a cell that is to be expanded.
void Potential::surround(int x, int y) {
  const int tile_x = x / kTile;
  const int tile_y = y / kTile;
  const int number = tile_y * tiles_.x + tile_x;
  TileState& tile = tiles_.state[static_cast<std::size_t>(number)];
  if (tile == TileState::kSurrounded) return;
  for (int ty = std::max(0, tile_y - 1); ty <= std::min(tiles_.y - 1, tile_y + 1); ++ty) {
    for (int tx = std::max(0, tile_x - 1); tx <= std::min(tiles_.x - 1, tile_x + 1); ++tx) {
      fill_tile(tx, ty);
    }
  }
  tile = TileState::kSurrounded;
}

// Queues what is open by its cost to the new start.
void Potential::aim(Cell start) {
  const std::vector<Packed> items = queue_.take_all();
  ends_.start = start;
  unsigned shift = 0;
  while ((steps_.least_straight >> (shift + 3)) > 0) ++shift;
  queue_.reset(heuristic(ends_.goal.x, ends_.goal.y), shift);
  for (const Packed p : items) {
    const std::size_t i = index(p);
    if ((cells_.state[i] & kOpen) != 0) {
      queue_.push(std::uint64_t{cells_.value[i]} + heuristic(x_of(p), y_of(p)), p);
    }
  }
}

Potential::Result Potential::run(const CancelFlag& cancel) {
  surround(ends_.start.x, ends_.start.y);
  const std::uint32_t& found = cells_.value[index(ends_.start.x, ends_.start.y)];
  std::vector<Packed> later;
  Result result = Result::kFound;
  while (true) {
    if (!queue_.advance()) break;
    if (queue_.lower_bound() >= found) break;
    const Packed p = queue_.pop();
    const std::size_t i = index(p);
    if ((cells_.state[i] & kOpen) == 0) continue;
    if (std::uint64_t{cells_.value[i]} + heuristic(x_of(p), y_of(p)) >= found) {
      later.push_back(p);
      continue;
    }
    expand(p);
    if ((++expanded_.now & 0xFFFU) == 0 && cancel.load(std::memory_order_relaxed)) {
      result = Result::kCanceled;
      break;
    }
  }
  for (const Packed p : later) {
    queue_.push(std::uint64_t{cells_.value[index(p)]} + heuristic(x_of(p), y_of(p)), p);
  }
  if (result == Result::kFound && found == kUnreached) result = Result::kNoPath;
  return result;
}

void Potential::expand(Packed p) {
  const int x = x_of(p);
  const int y = y_of(p);
  surround(x, y);
  const std::size_t i = index(x, y);
  cells_.state[i] &= static_cast<std::uint8_t>(~kOpen);
  std::array<bool, 4> free{};
  for (int d = 0; d < 4; ++d) {
    const std::uint32_t length = steps_.straight[cells_.cost[i + offset_[d]]];
    free[d] = length != kBlockedStep;
    if (free[d]) relax(i, x + kDx[d], y + kDy[d], static_cast<std::uint8_t>(opposite(d)), length);
  }
  for (int d = 4; d < 8; ++d) {
    if (!free[kCut[d - 4][0]] || !free[kCut[d - 4][1]]) continue;
    const std::uint32_t length = steps_.diagonal[cells_.cost[i + offset_[d]]];
    if (length == kBlockedStep) continue;
    relax(i, x + kDx[d], y + kDy[d], static_cast<std::uint8_t>(opposite(d)), length);
  }
}

}  // namespace trident::nav
