// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "planning/grids/bucket_queue.h"
#include "planning/grids/travel_costs.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// How much it costs at least to travel from a cell to the goal among the obstacles, for a robot
/// that moves in any direction: Dijkstra's algorithm from the goal over blocks of cells, which goes
/// no farther than the farthest cell that was asked for. Kept as long as goal and costs stay.
///
/// A block is 1 x 1 or 2 x 2 cells; it is closed when all of its cells are at 253 or more (unknown
/// ones by choice), and costs the mean of its open cells.
class ObstacleHeuristic {
 public:
  struct Options {
    TravelCosts costs;
    bool crosses_unknown = true;
    bool halves = true;          ///< Blocks of 2 x 2 cells.
    bool keeps_changed = false;  ///< The values stay when the costs change, but not the goal.
  };
  static constexpr float kUnreachable = std::numeric_limits<float>::infinity();

  explicit ObstacleHeuristic(const Options& options);

  /// Values are those for this goal from now on. The costs must live until the next call.
  void aim(const CostGrid& grid, Cell goal);
  /// Searches until the value at a cell is known; false when canceled before.
  bool reach(Cell cell, const CancelFlag& cancel);
  /// The first cell along the steepest descent from a cell whose value is known and finite at which
  /// the cost is `value` or less.
  Cell descend(Cell from, float value);
  /// The cost from a cell of the grid [lengths of cells].
  float at(int x, int y) {
    const std::size_t i = block_of(x, y);
    if (value_[i] > settled_) extend(i);
    return value_[i] == kOpen ? kUnreachable : static_cast<float>(value_[i]) * (1.0F / kScale);
  }

 private:
  static constexpr std::uint32_t kOpen = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t kNotMeasured = 0;  ///< Of steps.
  static constexpr std::uint32_t kScale = 256;      ///< Values per length of a cell.

  std::size_t block_of(int x, int y) const {
    return static_cast<std::size_t>((y >> halving_) + 1) * stride_ +
           static_cast<std::size_t>((x >> halving_) + 1);
  }
  bool is_kept(const CostGrid& grid, Cell goal) const;
  void allocate();
  void seed();
  std::uint32_t step_of(std::size_t block) {
    if (step_[block] == kNotMeasured) measure_from(block);
    return step_[block];
  }
  void measure_from(std::size_t block);
  std::uint32_t measure(int bx, int by) const;
  void offer(std::size_t block, std::uint32_t value);
  void extend(std::size_t block);
  bool advance_once();

  Options options_;
  unsigned halving_;
  std::array<std::uint32_t, 256> cell_cost_{};  ///< 0: closed.
  CostGrid grid_;
  Cell goal_{-1, -1};
  std::vector<std::uint8_t> seen_;  ///< The costs of which the values are.
  std::size_t stride_ = 0;
  int columns_ = 0, rows_ = 0;
  std::uint32_t settled_ = 0;  ///< Values up to this one are final.
  std::vector<std::uint32_t> value_, step_;
  BucketQueue<std::uint32_t> queue_;
};

}  // namespace trident::nav
