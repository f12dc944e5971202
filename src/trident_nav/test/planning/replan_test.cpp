// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Plans over cells after the costs have changed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "planning/grids/grid_route.h"
#include "planning/grids/line_cost.h"
#include "planning/reference_search.h"
#include "trident_base/random_stream.h"

namespace trident::nav {
namespace {

using testing::kRunning;
using testing::reference_potential;
using testing::TestGrid;

GridRouteOptions navfn_like() {
  GridRouteOptions options;
  for (std::size_t c = 0; c <= 252; ++c) {
    options.costs.step[c] = 50.0F + 0.8F * static_cast<float>(c);
  }
  options.detours = true;
  return options;
}

/// Plans between the middles of two cells, again and again.
class Replans : public ::testing::Test {
 protected:
  GridRouteResult plan(Cell start, Cell goal) {
    const Point2 a = grid_.geometry.center(start), b = grid_.geometry.center(goal);
    return route_.find(grid_.view(), {}, {a.x, a.y, 0.0}, {b.x, b.y, 0.0}, kRunning);
  }
  double least(Cell start, Cell goal) {
    const CostGrid view = grid_.view();
    return reference_potential(view, navfn_like().costs, goal)[view.geometry.index(start)];
  }
  void box(int x0, int y0, int side, std::uint8_t cost) {
    for (int y = std::max(0, y0); y < std::min(grid_.geometry.height, y0 + side); ++y) {
      for (int x = std::max(0, x0); x < std::min(grid_.geometry.width, x0 + side); ++x) {
        grid_(x, y) = cost;
      }
    }
  }
  /// The path is free, costs what the result says, and no more than the least over cells.
  void expect_good(const GridRouteResult& result, Cell start, Cell goal) {
    const double expected = least(start, goal);
    if (std::isinf(expected)) {
      EXPECT_EQ(result.failure, Failure::kNoPath);
      return;
    }
    ASSERT_EQ(result.failure, Failure::kNone) << result.reason;
    const double along = path_cost(grid_.view(), navfn_like().costs, result.points);
    EXPECT_LE(result.cost, expected * (1.0 + 5e-5));
    EXPECT_LE(along, result.cost + 252.0);  // the ends' own cells count by halves
  }

  TestGrid grid_{420, 160};
  GridRoute route_{navfn_like()};
};

TEST_F(Replans, ABoxOnALongPathIsLedAroundWithoutASearchFromTheGoal) {
  const Cell start{10, 20}, goal{410, 130};
  const GridRouteResult before = plan(start, goal);
  box(200, 70, 8, kLethalCost);
  const GridRouteResult after = plan(start, goal);
  EXPECT_EQ(route_.potential().expanded(), 0U);
  expect_good(after, start, goal);
  EXPECT_GT(path_cost(grid_.view(), navfn_like().costs, after.points), 0.0);
  EXPECT_NE(after.points.size(), before.points.size());
}

TEST_F(Replans, AWallThatForcesALongDetourIsTakenIntoThePotential) {
  const Cell start{10, 20}, goal{410, 20};
  plan(start, goal);
  for (int y = 0; y < 150; ++y) grid_(200, y) = kLethalCost;
  const GridRouteResult after = plan(start, goal);
  EXPECT_GT(route_.potential().expanded(), 0U);
  EXPECT_NEAR(after.cost, least(start, goal), 5e-5 * after.cost);
  expect_good(after, start, goal);
}

TEST_F(Replans, PathsStayGoodWhileBoxesComeAndGo) {
  const RandomStream random(11, "boxes");
  std::uint64_t n = 0;
  const auto number = [&](int below) { return static_cast<int>(random.uniform(n++, 0) * below); };
  const Cell goal{405, 140};
  std::size_t detours = 0;
  for (int round = 0; round < 40; ++round) {
    const Cell start{10 + 8 * round, 20 + number(20)};
    for (int k = 0; k < 6; ++k) {
      const std::uint8_t costs[] = {kLethalCost, kFreeCost, 40, 200};
      box(number(400), number(150), 2 + number(9), costs[k % 4]);
    }
    box(start.x - 3, start.y - 3, 7, kFreeCost);
    box(goal.x - 3, goal.y - 3, 7, kFreeCost);
    const GridRouteResult result = plan(start, goal);
    expect_good(result, start, goal);
    if (round > 0 && route_.potential().expanded() == 0) ++detours;
  }
  EXPECT_GT(detours, 0U);
}

}  // namespace
}  // namespace trident::nav
