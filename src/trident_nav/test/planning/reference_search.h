// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "planning/grids/step_costs.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav::testing {

/// Of a plan that nobody cancels.
inline const CancelFlag kRunning{false};

/// A grid that owns its costs; 1 m cells, origin 0 unless changed.
struct TestGrid {
  TestGrid(int width, int height, std::uint8_t cost = kFreeCost, double resolution = 1.0);
  CostGrid view() const;
  std::uint8_t& operator()(int x, int y) { return cost[geometry.index({x, y})]; }
  /// Computes the exact distance to the nearest lethal cell, by comparing with all.
  void measure_distances(float max_distance_m);

  GridGeometry geometry;
  std::vector<std::uint8_t> cost;
  std::vector<float> distance_m;
  float max_distance_m = 0.0F;
  std::uint64_t revision = 0;
};

/// The least costs from all cells to the goal by Dijkstra's algorithm with a binary heap and double
/// precision; infinite where there is no path. A step costs its length times the step cost of the
/// cell that lies farther from the goal; a diagonal step needs both cells next to it.
std::vector<double> reference_potential(const CostGrid& grid, const StepCosts& costs, Cell goal);

}  // namespace trident::nav::testing
