// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/poses/obstacle_heuristic.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace trident::nav {
namespace {

/// The step of closed blocks, and of the rim around the grid.
constexpr std::uint32_t kClosedStep = 0xFFFFFFFFU;
/// Of the buckets: not wider than the cheapest step, so that what leaves the queue is final.
constexpr unsigned kBucketShift = 7;
/// A goal in closed blocks is entered from open ones this many blocks away.
constexpr int kEntry = 4;
constexpr int kCancelInterval = 4096;
/// Blocks that are measured together.
constexpr int kRun = 16;

/// Times sqrt 2, in whole numbers.
std::uint32_t diagonal(std::uint32_t step) {
  return static_cast<std::uint32_t>((std::uint64_t{step} * 92682U) >> 16U);
}

}  // namespace

ObstacleHeuristic::ObstacleHeuristic(const Options& options)
    : options_(options), halving_(options.halves ? 1 : 0) {
  for (std::size_t c = 0; c < cell_cost_.size(); ++c) {
    cell_cost_[c] = static_cast<std::uint32_t>(
        std::lround(std::max(0.5, static_cast<double>(options.costs.factor[c])) * kScale));
  }
  cell_cost_[kInscribedCost] = cell_cost_[kLethalCost] = 0;
  if (!options.crosses_unknown) cell_cost_[kUnknownCost] = 0;
}

bool ObstacleHeuristic::is_kept(const CostGrid& grid, Cell goal) const {
  if (!(goal_ == goal) || !(grid_.geometry == grid.geometry)) return false;
  return options_.keeps_changed || std::memcmp(seen_.data(), grid.cost, seen_.size()) == 0;
}

void ObstacleHeuristic::aim(const CostGrid& grid, Cell goal) {
  const bool kept = is_kept(grid, goal);
  grid_ = grid;
  if (kept) return;
  goal_ = goal;
  seen_.assign(grid.cost, grid.cost + grid.geometry.size());
  allocate();
  seed();
}

void ObstacleHeuristic::allocate() {
  columns_ = (grid_.geometry.width - 1) / (1 << halving_) + 1;
  rows_ = (grid_.geometry.height - 1) / (1 << halving_) + 1;
  stride_ = static_cast<std::size_t>(columns_) + 2;
  const std::size_t size = stride_ * (static_cast<std::size_t>(rows_) + 2);
  value_.assign(size, kOpen);
  step_.assign(size, kNotMeasured);
  const std::size_t last = size - stride_;
  for (std::size_t x = 0; x < stride_; ++x) step_[x] = step_[last + x] = kClosedStep;
  for (std::size_t i = 0; i < size; i += stride_) step_[i] = step_[i + stride_ - 1] = kClosedStep;
  queue_.reset(0, kBucketShift);
  settled_ = 0;
}

// The goal's block; when it is closed, also the blocks around, at the highest cost.
void ObstacleHeuristic::seed() {
  const std::size_t center = block_of(goal_.x, goal_.y);
  const bool closed = step_of(center) == kClosedStep;
  const int reach = closed ? kEntry : 0;
  const int cx = goal_.x >> halving_, cy = goal_.y >> halving_;
  const double per_block = cell_cost_[kInscribedCost - 1] * static_cast<double>(1U << halving_);
  for (int y = std::max(0, cy - reach); y <= std::min(rows_ - 1, cy + reach); ++y) {
    for (int x = std::max(0, cx - reach); x <= std::min(columns_ - 1, cx + reach); ++x) {
      const std::size_t i =
          static_cast<std::size_t>(y + 1) * stride_ + static_cast<std::size_t>(x + 1);
      offer(i, static_cast<std::uint32_t>(per_block * std::hypot(x - cx, y - cy)));
    }
  }
}

// Measures a block and those next to it in its row.
void ObstacleHeuristic::measure_from(std::size_t block) {
  const int by = static_cast<int>(block / stride_) - 1;
  const int first = (static_cast<int>(block % stride_) - 1) / kRun * kRun;
  std::uint32_t* steps = &step_[static_cast<std::size_t>(by + 1) * stride_ + 1];
  const bool is_whole = halving_ == 1 && 2 * by + 1 < grid_.geometry.height;
  const std::uint8_t* low = &seen_[grid_.geometry.index({0, by << halving_})];
  const std::uint8_t* high = is_whole ? low + grid_.geometry.width : low;
  for (int bx = first; bx < std::min(columns_, first + kRun); ++bx) {
    if (!is_whole || 2 * bx + 1 >= grid_.geometry.width) {
      steps[bx] = measure(bx, by);
      continue;
    }
    const std::uint32_t costs[] = {cell_cost_[low[2 * bx]], cell_cost_[low[2 * bx + 1]],
                                   cell_cost_[high[2 * bx]], cell_cost_[high[2 * bx + 1]]};
    const std::uint32_t sum = costs[0] + costs[1] + costs[2] + costs[3];
    const int open = (costs[0] != 0) + (costs[1] != 0) + (costs[2] != 0) + (costs[3] != 0);
    steps[bx] = open == 4   ? sum / 2
                : open == 0 ? kClosedStep
                            : 2 * sum / static_cast<std::uint32_t>(open);
  }
}

std::uint32_t ObstacleHeuristic::measure(int bx, int by) const {
  const int side = 1 << halving_;
  const GridGeometry& g = grid_.geometry;
  std::uint32_t sum = 0, count = 0;
  for (int y = by * side; y < std::min(g.height, (by + 1) * side); ++y) {
    for (int x = bx * side; x < std::min(g.width, (bx + 1) * side); ++x) {
      const std::uint32_t cost = cell_cost_[seen_[g.index({x, y})]];
      sum += cost;
      count += cost != 0 ? 1 : 0;
    }
  }
  return count == 0 ? kClosedStep : sum * static_cast<std::uint32_t>(side) / count;
}

inline void ObstacleHeuristic::offer(std::size_t block, std::uint32_t value) {
  if (value >= value_[block]) return;
  value_[block] = value;
  queue_.push(value, static_cast<std::uint32_t>(block));
}

// Settles one block; false when there are no more.
bool ObstacleHeuristic::advance_once() {
  if (!queue_.advance()) {
    settled_ = kOpen;
    return false;
  }
  const auto bound = static_cast<std::uint32_t>(queue_.lower_bound());
  settled_ = bound == 0 ? 0 : bound - 1;
  const std::uint32_t i = queue_.pop();
  const std::uint32_t value = value_[i];
  if (value < bound) return true;  // It has been settled at a lower value.
  const std::uint32_t step = step_of(i);
  // A step costs the block that it leaves, seen from the start; closed ones are only passed at the
  // goal.
  const auto east = static_cast<std::ptrdiff_t>(1), north = static_cast<std::ptrdiff_t>(stride_);
  for (const std::ptrdiff_t d : {east, -east, north, -north}) {
    const std::size_t j = i + static_cast<std::size_t>(d);
    const std::uint32_t cost = step_of(j);
    if (cost != kClosedStep) offer(j, value + (step == kClosedStep ? cost : (cost + step) / 2));
  }
  for (const std::ptrdiff_t d : {north + east, north - east, -north + east, -north - east}) {
    const std::size_t j = i + static_cast<std::size_t>(d);
    const std::uint32_t cost = step_of(j);
    if (cost != kClosedStep)
      offer(j, value + diagonal(step == kClosedStep ? cost : (cost + step) / 2));
  }
  return true;
}

void ObstacleHeuristic::extend(std::size_t block) {
  while (value_[block] > settled_ && advance_once()) {
  }
}

bool ObstacleHeuristic::reach(Cell cell, const CancelFlag& cancel) {
  const std::size_t block = block_of(cell.x, cell.y);
  for (int n = 0; value_[block] > settled_; ++n) {
    if (n % kCancelInterval == 0 && cancel.load(std::memory_order_relaxed)) return false;
    if (!advance_once()) break;
  }
  return true;
}

Cell ObstacleHeuristic::descend(Cell from, float value) {
  std::size_t i = block_of(from.x, from.y);
  const auto north = static_cast<std::ptrdiff_t>(stride_);
  while (static_cast<float>(value_[i]) > value * kScale) {
    std::size_t best = i;
    for (const std::ptrdiff_t row : {-north, std::ptrdiff_t{0}, north}) {
      for (const std::ptrdiff_t column : {-1, 0, 1}) {
        const std::size_t j = i + static_cast<std::size_t>(row + column);
        if (value_[j] < value_[best]) best = j;
      }
    }
    if (best == i) break;
    i = best;
  }
  const int x = (static_cast<int>(i % stride_) - 1) << halving_;
  const int y = (static_cast<int>(i / stride_) - 1) << halving_;
  return {x, y};
}

}  // namespace trident::nav
