// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/planning/robot_planner.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planning/curves/footprint_contact.h"
#include "planning/reference_search.h"
#include "trident_base/angle.h"

namespace trident::nav {
namespace {

using testing::kRunning;
using testing::TestGrid;

constexpr double kRadius_m = 0.75;

Footprint car_footprint() {
  Footprint footprint;
  footprint.points = {{-0.1, -0.165}, {0.42, -0.165}, {0.42, 0.165}, {-0.1, 0.165}};
  return completed(footprint);
}

MotionLimits limits_of(double radius_m, double vx_min) {
  MotionLimits limits;
  limits.vx_max = 1.0;
  limits.vx_min = vx_min;
  limits.wz_max = 1.3;
  limits.min_turning_radius = radius_m;
  return limits;
}

/// The path to a goal to the left of the robot, with the same heading.
Path path_aside(const MotionLimits& limits) {
  const TestGrid grid(120, 120, kFreeCost, 0.05);
  RobotPlanner planner{RobotPlannerParams{}};
  const PlanOutcome outcome = planner.plan(grid.view(), car_footprint(), {3.0, 3.0, 0.0},
                                           {3.0, 3.8, 0.0}, limits, kRunning);
  EXPECT_EQ(outcome.failure, Failure::kNone) << outcome.reason;
  return outcome.path;
}

double length_of(const Path& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i)
    length_m += distance(path[i - 1].x, path[i - 1].y, path[i].x, path[i].y);
  return length_m;
}

/// Whether a step of a path is driven tail first.
bool has_reverse(const Path& path) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double along = std::cos(path[i - 1].yaw) * (path[i].x - path[i - 1].x) +
                         std::sin(path[i - 1].yaw) * (path[i].y - path[i - 1].y);
    if (along < -1e-6) return true;
  }
  return false;
}

TEST(RobotPlanner, GoesStraightWithARobotThatTurnsOnTheSpot) {
  EXPECT_NEAR(length_of(path_aside(limits_of(0.0, -0.5))), 0.8, 0.02);
}

TEST(RobotPlanner, KeepsTheTurningRadiusOfACar) {
  const Path path = path_aside(limits_of(kRadius_m, -0.5));
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double step_m = distance(path[i - 1].x, path[i - 1].y, path[i].x, path[i].y);
    const double turn = std::fabs(wrap_angle(path[i].yaw - path[i - 1].yaw));
    EXPECT_LE(turn, step_m / kRadius_m * 1.01 + 1e-6) << "at point " << i;
  }
  EXPECT_TRUE(has_reverse(path));
}

TEST(RobotPlanner, PlansNoReverseForACarThatHasNone) {
  const Path path = path_aside(limits_of(kRadius_m, 0.0));
  EXPECT_FALSE(has_reverse(path));
  EXPECT_GT(length_of(path), 2.0 * kPi * kRadius_m * 0.8);
}

}  // namespace
}  // namespace trident::nav
