// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/grids/jump_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "planning/reference_search.h"
#include "trident_base/random_stream.h"

namespace trident::nav {
namespace {

using testing::kRunning;
using testing::TestGrid;

StepCosts equal_costs() {
  StepCosts costs;
  costs.step[kFreeCost] = 1.0F;
  return costs;
}

TestGrid random_grid(int width, int height, double density, std::uint64_t seed) {
  const RandomStream random(seed, "cells");
  TestGrid grid(width, height);
  std::uint64_t n = 0;
  for (auto& cost : grid.cost) {
    if (random.uniform(n++, 0) < density) cost = kLethalCost;
  }
  grid.revision = seed + 1;
  return grid;
}

// The length of a path of cells; infinite if a step leaves the grid's free cells or cuts a corner.
double length_of(const std::vector<Cell>& cells, const TestGrid& grid) {
  const CostGrid view = grid.view();
  const auto is_free = [&](int x, int y) { return view.at(Cell{x, y}) == kFreeCost; };
  double length = 0.0;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const Cell a = cells[i - 1];
    const Cell b = cells[i];
    const bool is_step = std::abs(b.x - a.x) <= 1 && std::abs(b.y - a.y) <= 1 && !(a == b);
    if (!is_step || !is_free(b.x, b.y) || !is_free(a.x, b.y) || !is_free(b.x, a.y)) return INFINITY;
    length += a.x != b.x && a.y != b.y ? std::sqrt(2.0) : 1.0;
  }
  return length;
}

// Paths from all over a grid to one goal have the lengths that Dijkstra's algorithm finds.
void expect_shortest(const TestGrid& grid, Cell goal, int stride) {
  const CostGrid view = grid.view();
  const auto expected = testing::reference_potential(view, equal_costs(), goal);
  JumpPoints jumps(equal_costs());
  ASSERT_TRUE(jumps.read(view));
  for (int i = 0; i < static_cast<int>(view.geometry.size()); i += stride) {
    const Cell start{i % view.geometry.width, i / view.geometry.width};
    if (view.at(start) != kFreeCost) continue;
    const double least = expected[view.geometry.index(start)];
    const auto result = jumps.search(start, goal, kRunning);
    if (std::isinf(least)) {
      EXPECT_EQ(result, JumpPoints::Result::kNoPath);
      continue;
    }
    ASSERT_EQ(result, JumpPoints::Result::kFound) << start.x << " " << start.y;
    ASSERT_NEAR(jumps.cost(), least, 1e-9 * (1.0 + least)) << start.x << " " << start.y;
    const auto& cells = jumps.path();
    ASSERT_EQ(cells.front(), start);
    ASSERT_EQ(cells.back(), goal);
    ASSERT_NEAR(length_of(cells, grid), least, 1e-9 * (1.0 + least));
  }
}

class RandomGrids : public ::testing::TestWithParam<double> {};

TEST_P(RandomGrids, PathsAreShortest) {
  const int sizes[][2] = {{1, 1}, {63, 5}, {64, 64}, {65, 130}, {200, 40}};
  std::uint64_t seed = 1;
  for (const auto& size : sizes) {
    for (int k = 0; k < 4; ++k) {
      TestGrid grid = random_grid(size[0], size[1], GetParam(), seed++);
      const Cell goal{size[0] / 3, size[1] / 2};
      grid(goal.x, goal.y) = kFreeCost;
      expect_shortest(grid, goal, 7);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Densities, RandomGrids, ::testing::Values(0.0, 0.02, 0.1, 0.3, 0.45));

TEST(JumpPoints, EqualCostsThatAreNotOneScaleTheCost) {
  StepCosts costs;
  costs.step[7] = 2.5F;
  JumpPoints jumps(costs);
  const TestGrid grid(20, 3, 7);
  ASSERT_TRUE(jumps.read(grid.view()));
  ASSERT_EQ(jumps.search({0, 1}, {19, 1}, kRunning), JumpPoints::Result::kFound);
  EXPECT_DOUBLE_EQ(jumps.cost(), 19 * 2.5);
}

TEST(JumpPoints, DifferentCostsAreRefusedUntilTheyAreGone) {
  StepCosts costs = equal_costs();
  costs.step[10] = 2.0F;
  JumpPoints jumps(costs);
  TestGrid grid(8, 8);
  grid(3, 3) = 10;
  EXPECT_FALSE(jumps.read(grid.view()));
  grid(3, 3) = kLethalCost;
  ++grid.revision;
  EXPECT_TRUE(jumps.read(grid.view()));
}

TEST(JumpPoints, AnOutlineClosesTheBorder) {
  JumpPoints jumps(equal_costs(), true);
  TestGrid grid(9, 5);
  grid(4, 1) = grid(4, 2) = grid(4, 3) = kLethalCost;
  ASSERT_TRUE(jumps.read(grid.view()));
  EXPECT_EQ(jumps.search({2, 2}, {6, 2}, kRunning), JumpPoints::Result::kNoPath);
}

TEST(JumpPoints, ASearchCanBeCanceled) {
  JumpPoints jumps(equal_costs());
  const TestGrid grid = random_grid(300, 300, 0.3, 5);
  ASSERT_TRUE(jumps.read(grid.view()));
  const CancelFlag canceled{true};
  const Cell start{1, 1};
  const Cell goal{298, 298};
  EXPECT_NE(jumps.search(start, goal, canceled), JumpPoints::Result::kFound);
}

}  // namespace
}  // namespace trident::nav
