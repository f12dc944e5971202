// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "reference_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace trident::nav::testing {

TestGrid::TestGrid(int width, int height, std::uint8_t value, double resolution)
    : geometry{width, height, resolution, 0.0, 0.0}, cost(geometry.size(), value) {}

CostGrid TestGrid::view() const {
  CostGrid grid;
  grid.geometry = geometry;
  grid.cost = cost.data();
  grid.distance_m = distance_m.empty() ? nullptr : distance_m.data();
  grid.max_distance_m = max_distance_m;
  grid.revision = revision;
  return grid;
}

void TestGrid::measure_distances(float max_m) {
  max_distance_m = max_m;
  distance_m.assign(geometry.size(), max_m);
  const int reach = static_cast<int>(max_m / geometry.resolution) + 1;
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      if (cost[geometry.index({x, y})] != kLethalCost) continue;
      for (int j = std::max(0, y - reach); j <= std::min(geometry.height - 1, y + reach); ++j) {
        for (int i = std::max(0, x - reach); i <= std::min(geometry.width - 1, x + reach); ++i) {
          float& d = distance_m[geometry.index({i, j})];
          d = std::min(d, static_cast<float>(std::hypot(i - x, j - y) * geometry.resolution));
        }
      }
    }
  }
}

std::vector<double> reference_potential(const CostGrid& grid, const StepCosts& costs, Cell goal) {
  const GridGeometry& g = grid.geometry;
  std::vector<double> best(g.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::pair<int, int>>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap;
  const auto open = [&](int x, int y) {
    return g.contains({x, y}) && !costs.blocked(grid.at(Cell{x, y}));
  };
  best[g.index(goal)] = 0.0;
  heap.push({0.0, {goal.x, goal.y}});
  while (!heap.empty()) {
    const auto [value, at] = heap.top();
    const auto [x, y] = at;
    heap.pop();
    if (value > best[g.index({x, y})]) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (!open(x + dx, y + dy) || !open(x + dx, y) || !open(x, y + dy)) continue;
        const double length = dx != 0 && dy != 0 ? std::sqrt(2.0) : 1.0;
        const double next = value + length * costs.step[grid.at(Cell{x + dx, y + dy})];
        double& known = best[g.index({x + dx, y + dy})];
        if (next < known) heap.push({known = next, {x + dx, y + dy}});
      }
    }
  }
  return best;
}

}  // namespace trident::nav::testing
