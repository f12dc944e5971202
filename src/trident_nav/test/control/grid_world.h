// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "trident_nav/core/cost_grid.h"

namespace trident::nav::testing {

/// A rectangle of obstacles [m].
struct Block {
  double x0, y0, x1, y1;
};

/// A world of obstacles, with the costmap that a perfect sensor would make of it.
class GridWorld {
 public:
  GridWorld(double width_m, double height_m, double resolution = 0.05);

  /// Occupies or frees the cells whose centers lie in a rectangle, and makes the costmap again.
  void fill(const Block& block, std::uint8_t cost = kLethalCost);
  /// The costs of the cells around obstacles, by costmap_2d's formula.
  void inflate(double inscribed_radius, double inflation_radius, double cost_scaling_factor);

  CostGrid grid() const;

 private:
  void measure();

  GridGeometry geometry_;
  std::vector<std::uint8_t> cost_;
  std::vector<float> distance_m_;
  std::uint64_t revision_ = 0;
};

/// The cheapest path for the inscribed circle on the grid's cells, smoothed; empty if
/// nothing leads to the goal. Its last pose is the goal.
Path plan_on(const CostGrid& grid, const Pose2& start, const Pose2& goal, double inscribed_radius);

}  // namespace trident::nav::testing
