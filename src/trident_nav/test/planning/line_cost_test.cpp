// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/grids/line_cost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planning/grids/path_points.h"
#include "planning/reference_search.h"

namespace trident::nav {
namespace {

using testing::TestGrid;

StepCosts unit_costs() {
  StepCosts costs;
  for (int c = 0; c <= 252; ++c) costs.step[c] = 1.0F + static_cast<float>(c);
  return costs;
}

TEST(LineCost, IsTheLengthInFreeSpace) {
  TestGrid grid(20, 20, kFreeCost, 0.5);
  EXPECT_NEAR(line_cost(grid.view(), unit_costs(), {1.1, 1.2}, {7.3, 8.9}),
              std::hypot(6.2, 7.7) / 0.5, 1e-9);
  EXPECT_NEAR(line_cost(grid.view(), unit_costs(), {7.3, 8.9}, {1.1, 1.2}),
              std::hypot(6.2, 7.7) / 0.5, 1e-9);
}

TEST(LineCost, WeighsEachCellByTheLengthWithin) {
  TestGrid grid(4, 1);
  grid(1, 0) = 9;
  EXPECT_NEAR(line_cost(grid.view(), unit_costs(), {0.5, 0.5}, {2.5, 0.5}), 0.5 + 10.0 + 0.5, 1e-9);
}

TEST(LineCost, DoesNotPassBlockedCellsNorTheirCorners) {
  TestGrid grid(10, 10);
  grid(5, 4) = kLethalCost;
  EXPECT_TRUE(std::isinf(line_cost(grid.view(), unit_costs(), {1.5, 4.5}, {9.5, 4.5})));
  EXPECT_TRUE(std::isinf(line_cost(grid.view(), unit_costs(), {4.5, 4.5}, {5.5, 5.5})));
  EXPECT_FALSE(std::isinf(line_cost(grid.view(), unit_costs(), {4.5, 5.5}, {6.5, 5.5})));
  EXPECT_TRUE(std::isinf(line_cost(grid.view(), unit_costs(), {4.5, 5.5}, {14.5, 5.5})));
}

TEST(PullTaut, MakesStairsALine) {
  TestGrid grid(40, 40);
  const auto points = pull_taut(grid.view(), unit_costs(),
                                {{0.5, 0.5}, {1.5, 1.5}, {2.5, 1.5}, {3.5, 2.5}, {4.5, 2.5}});
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points.back().x, 4.5);
}

TEST(PullTaut, KeepsADetourAroundHighCosts) {
  TestGrid grid(21, 21);
  for (int y = 0; y < 20; ++y) grid(10, y) = 200;
  std::vector<Point2> points;
  for (int y = 5; y <= 20; ++y) points.push_back({5.5, y + 0.5});
  for (int x = 6; x <= 15; ++x) points.push_back({x + 0.5, 20.5});
  for (int y = 19; y >= 5; --y) points.push_back({15.5, y + 0.5});
  EXPECT_GT(pull_taut(grid.view(), unit_costs(), points).size(), 2U);
}

TEST(PosesAlong, AreAtMostTheSpacingApartAndFaceForward) {
  const Path path = poses_along({{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}, {1.0, 0.33}}, 0.1, 2.0);
  EXPECT_EQ(path.size(), 1U + 10U + 4U);
  EXPECT_DOUBLE_EQ(path.front().yaw, 0.0);
  EXPECT_DOUBLE_EQ(path[10].yaw, std::atan2(1.0, 0.0));
  EXPECT_DOUBLE_EQ(path.back().yaw, 2.0);
  EXPECT_NEAR(path_length(path), 1.33, 1e-12);
}

}  // namespace
}  // namespace trident::nav
