// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What navfn, global_planner, carrot_planner and Theta* each do on their own.
#include <gtest/gtest.h>

#include <cmath>

#include "planning/grids/path_points.h"
#include "planning/reference_search.h"
#include "trident_base/error.h"
#include "trident_nav/planning/carrot_planner.h"
#include "trident_nav/planning/global_planner.h"
#include "trident_nav/planning/navfn_planner.h"
#include "trident_nav/planning/planner_registry.h"
#include "trident_nav/planning/theta_star_planner.h"

namespace trident::nav {
namespace {

using testing::kRunning;
using testing::TestGrid;

PlanOutcome run(Planner& planner, const TestGrid& grid, const Pose2& start, const Pose2& goal) {
  Footprint footprint;
  footprint.inscribed_radius = footprint.circumscribed_radius = 0.5;
  return planner.plan(grid.view(), footprint, start, goal, MotionLimits{}, kRunning);
}

/// A wall with a gap at its upper end.
TestGrid wall_grid() {
  TestGrid grid(40, 40);
  for (int y = 0; y < 35; ++y) grid(20, y) = kLethalCost;
  return grid;
}

TEST(NavfnPlanner, CostIsThatOfDijkstrasAlgorithm) {
  TestGrid grid = wall_grid();
  grid(20, 37) = 100;
  for (int x = 0; x < 40; ++x) grid(x, 20) = 80;
  StepCosts costs;
  for (int c = 0; c <= 252; ++c) costs.step[c] = 50.0F + 0.8F * static_cast<float>(c);
  NavfnPlanner planner{NavfnParams{}};
  const PlanOutcome outcome = run(planner, grid, {5.5, 5.5, 0.0}, {35.5, 5.5, 0.0});
  ASSERT_EQ(outcome.failure, Failure::kNone);
  const double expected =
      testing::reference_potential(grid.view(), costs, {35, 5})[grid.geometry.index({5, 5})];
  EXPECT_NEAR(outcome.cost, expected, 1e-5 * expected);
}

TEST(NavfnPlanner, APathInTheOpenIsStraight) {
  TestGrid grid(100, 100);
  NavfnPlanner planner{NavfnParams{}};
  const PlanOutcome outcome = run(planner, grid, {5.5, 5.5, 0.0}, {90.2, 40.9, 1.0});
  EXPECT_NEAR(path_length(outcome.path), std::hypot(84.7, 35.4), 1e-9);
  EXPECT_EQ(outcome.path.back().yaw, 1.0);
}

TEST(NavfnPlanner, AnOccupiedGoalNeedsATolerance) {
  TestGrid grid = wall_grid();
  NavfnPlanner strict{NavfnParams{}};
  EXPECT_EQ(run(strict, grid, {5.5, 5.5, 0.0}, {20.5, 10.5, 0.0}).failure, Failure::kGoalOccupied);
  NavfnParams params;
  params.default_tolerance = 2.0;
  NavfnPlanner tolerant{params};
  const PlanOutcome outcome = run(tolerant, grid, {5.5, 5.5, 0.0}, {20.5, 10.5, 0.0});
  ASSERT_EQ(outcome.failure, Failure::kNone);
  EXPECT_NEAR(outcome.path.back().x, 19.5, 1e-9);
  EXPECT_NE(outcome.reason.find("1.00 m from it"), std::string::npos) << outcome.reason;
}

TEST(NavfnPlanner, TheNearestReachableCellCounts) {
  TestGrid grid(40, 40);
  // A closed box around the goal; the nearest cells outside of it are two cells away.
  for (int i = 28; i <= 32; ++i) {
    grid(i, 8) = grid(i, 12) = grid(28, i - 20) = grid(32, i - 20) = kLethalCost;
  }
  NavfnParams params;
  params.default_tolerance = 3.5;
  NavfnPlanner planner{params};
  const PlanOutcome outcome = run(planner, grid, {5.5, 10.5, 0.0}, {30.5, 10.5, 0.0});
  ASSERT_EQ(outcome.failure, Failure::kNone) << outcome.reason;
  EXPECT_NEAR(distance(outcome.path.back().x, outcome.path.back().y, 30.5, 10.5), 3.0, 1e-9);
  params.default_tolerance = 0.0;
  NavfnPlanner strict{params};
  EXPECT_EQ(run(strict, grid, {5.5, 10.5, 0.0}, {30.5, 10.5, 0.0}).failure, Failure::kNoPath);
}

TEST(NavfnPlanner, UnknownSpaceIsBlockedUnlessAllowed) {
  TestGrid grid = wall_grid();
  for (int y = 35; y < 40; ++y) grid(20, y) = kUnknownCost;
  NavfnPlanner open{NavfnParams{}};
  EXPECT_EQ(run(open, grid, {5.5, 5.5, 0.0}, {35.5, 5.5, 0.0}).failure, Failure::kNone);
  NavfnParams params;
  params.allow_unknown = false;
  NavfnPlanner closed{params};
  EXPECT_EQ(run(closed, grid, {5.5, 5.5, 0.0}, {35.5, 5.5, 0.0}).failure, Failure::kNoPath);
}

TEST(NavfnPlanner, ABlockedStartIsLeftUphill) {
  TestGrid grid(40, 40);
  for (int y = 0; y < 40; ++y) {
    grid(10, y) = kLethalCost;
    for (int x = 8; x <= 12; ++x) {
      if (x != 10) grid(x, y) = kInscribedCost;
    }
  }
  grid.measure_distances(10.0F);
  NavfnPlanner planner{NavfnParams{}};
  const PlanOutcome outcome = run(planner, grid, {11.5, 20.5, 0.0}, {30.5, 20.5, 0.0});
  ASSERT_EQ(outcome.failure, Failure::kNone);
  for (std::size_t i = 1; i < outcome.path.size(); ++i) {
    EXPECT_GE(outcome.path[i].x, outcome.path[i - 1].x - 1e-9);
  }
  EXPECT_NE(outcome.reason.find("leaves it at (13.50"), std::string::npos) << outcome.reason;
}

TEST(NavfnPlanner, ShowsItsPotential) {
  TestGrid grid(30, 30);
  NavfnPlanner planner{NavfnParams{}};
  EXPECT_TRUE(planner.potential().empty());
  run(planner, grid, {5.5, 5.5, 0.0}, {25.5, 5.5, 0.0});
  const auto potential = planner.potential();
  EXPECT_FLOAT_EQ(potential[grid.geometry.index({15, 5})], 500.0F);
}

TEST(GlobalPlanner, GridPathsFollowCells) {
  GlobalPlannerParams params;
  params.use_grid_path = true;
  GlobalPlanner planner{params};
  TestGrid grid(60, 60);
  const PlanOutcome outcome = run(planner, grid, {5.5, 5.5, 0.0}, {50.5, 20.5, 0.0});
  EXPECT_NEAR(path_length(outcome.path), 30.0 + 15.0 * std::sqrt(2.0), 1e-9);
}

TEST(GlobalPlanner, OrientationModes) {
  Path path;
  for (int i = 0; i <= 10; ++i) path.push_back({i * 1.0, 0.0, 0.0});
  path.front().yaw = 0.5;
  path.back().yaw = 1.5;
  const auto middle = [&](OrientationMode mode) {
    Path copy = path;
    set_orientations(copy, mode, 1);
    EXPECT_EQ(copy.front().yaw, 0.5);
    EXPECT_EQ(copy.back().yaw, 1.5);
    return copy[5].yaw;
  };
  constexpr double kPi = 3.14159265358979323846;
  EXPECT_DOUBLE_EQ(middle(OrientationMode::kNone), 0.0);
  EXPECT_DOUBLE_EQ(middle(OrientationMode::kForward), 0.0);
  EXPECT_DOUBLE_EQ(middle(OrientationMode::kInterpolate), 1.0);
  EXPECT_DOUBLE_EQ(std::abs(middle(OrientationMode::kBackward)), kPi);
  EXPECT_DOUBLE_EQ(middle(OrientationMode::kLeftward), -kPi / 2);
  EXPECT_DOUBLE_EQ(middle(OrientationMode::kRightward), kPi / 2);
  EXPECT_NEAR(middle(OrientationMode::kForwardThenInterpolate), 1.5 * 4.0 / 9.0, 1e-9);
}

TEST(GlobalPlanner, TheOutlineOfTheMapIsBlocked) {
  TestGrid grid = wall_grid();
  for (int y = 35; y < 39; ++y) grid(20, y) = kLethalCost;
  GlobalPlannerParams params;
  GlobalPlanner outlined{params};
  EXPECT_EQ(run(outlined, grid, {5.5, 5.5, 0.0}, {35.5, 5.5, 0.0}).failure, Failure::kNoPath);
  params.outline_map = false;
  GlobalPlanner open{params};
  EXPECT_EQ(run(open, grid, {5.5, 5.5, 0.0}, {35.5, 5.5, 0.0}).failure, Failure::kNone);
}

TEST(CarrotPlanner, StepsBackFromAnOccupiedGoal) {
  TestGrid grid = wall_grid();
  CarrotPlanner planner{CarrotPlannerParams{}};
  const PlanOutcome outcome = run(planner, grid, {5.5, 5.5, 0.0}, {20.5, 5.5, 0.3});
  ASSERT_EQ(outcome.path.size(), 2U);
  EXPECT_NEAR(outcome.path.back().x, 19.5, 1e-9);
  EXPECT_EQ(outcome.path.back().yaw, 0.3);
  const PlanOutcome through = run(planner, grid, {5.5, 5.5, 0.0}, {30.5, 5.5, 0.0});
  EXPECT_NE(through.reason.find("blocked at"), std::string::npos);
}

TEST(ThetaStarPlanner, FindsTheCornerThatTheGridMisses) {
  TestGrid grid = wall_grid();
  ThetaStarPlanner planner{ThetaStarParams{}};
  const PlanOutcome outcome = run(planner, grid, {2.5, 10.5, 0.0}, {38.5, 20.5, 0.0});
  const double shortest = std::hypot(17.0, 25.0) + 2.0 + std::hypot(17.0, 15.0);
  EXPECT_NEAR(path_length(outcome.path), shortest, 1e-9);
}

TEST(ThetaStarPlanner, RefusesFiveCorners) {
  EXPECT_THROW(builtin_planners().get("nav2_theta_star_planner/ThetaStarPlanner")(
                   parse_yaml("how_many_corners: 5", "x.yaml"), "x.yaml"),
               Error);
}

TEST(PlannerRegistry, ListsWhatItKnowsAndNamesTheNearest) {
  EXPECT_EQ(planner_name("nav2_navfn_planner::NavfnPlanner"), "nav2_navfn_planner/NavfnPlanner");
  try {
    builtin_planners().get("navfn/NavfnRos");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("navfn/NavfnROS"), std::string::npos);
  }
}

TEST(PlannerRegistry, ParametersAreChecked) {
  EXPECT_THROW(builtin_planners().get("global_planner/GlobalPlanner")(
                   parse_yaml("cost_factor: 7.0", "x.yaml"), "x.yaml"),
               ConfigError);
}

}  // namespace
}  // namespace trident::nav
