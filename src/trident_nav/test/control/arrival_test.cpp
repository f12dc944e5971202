// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "control/scene.h"
#include "trident_base/angle.h"
#include "trident_base/random_stream.h"
#include "trident_nav/control/last_command.h"

namespace trident::nav::testing {
namespace {

// The farthest that the robot is from the goal once it has been within the tolerance of it [m].
double overshoot(const Drive& result, const Pose2& goal, double tolerance_m) {
  double farthest = 0.0;
  bool was_near = false;
  for (const Pose2& p : result.track) {
    const double d = distance(p.x, p.y, goal.x, goal.y);
    was_near = was_near || d <= tolerance_m;
    if (was_near) farthest = std::max(farthest, d);
  }
  return farthest;
}

class ArrivesNearby : public ::testing::TestWithParam<const char*> {};

TEST_P(ArrivesNearby, WithAnyHeadingAndWithoutOvershoot) {
  const ControlSetup setup = burger();
  const RandomStream random(7, "goals");
  for (std::uint64_t i = 0; i < 40; ++i) {
    GridWorld world(4.0, 4.0);
    const double d = 0.05 + 0.95 * random.uniform(i, 0);
    const double bearing = 2.0 * kPi * random.uniform(i, 1);
    const Pose2 start{2.0, 2.0, 2.0 * kPi * random.uniform(i, 2) - kPi};
    const Pose2 goal{2.0 + d * std::cos(bearing), 2.0 + d * std::sin(bearing),
                     2.0 * kPi * random.uniform(i, 3) - kPi};
    const auto controller = make_controller(GetParam(), setup);
    const Drive result = drive(*controller, setup, {"near", world, start, goal}, 30.0);
    EXPECT_TRUE(result.is_reached) << "goal " << i << ": " << result.last_reason;
    EXPECT_EQ(result.failures, 0) << "goal " << i << ": " << result.last_reason;
    EXPECT_LE(result.position_error_m, setup.tolerance.xy_goal_tolerance);
    EXPECT_LE(result.heading_error_rad, setup.tolerance.yaw_goal_tolerance);
    EXPECT_LE(overshoot(result, goal, setup.tolerance.xy_goal_tolerance),
              setup.tolerance.xy_goal_tolerance)
        << "goal " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, ArrivesNearby, ::testing::Values("regulated_pure_pursuit", "mppi"),
                         [](const auto& info) { return std::string(info.param); });

class DrivesByLateOdometry : public ::testing::TestWithParam<const char*> {};

TEST_P(DrivesByLateOdometry, NearlyAsFastAsByThatOfNow) {
  const ControlSetup setup = burger();
  const Scene scene = straight_scene(setup.footprint);
  const auto time_s = [&](std::size_t late_periods) {
    const auto controller = make_controller(GetParam(), setup);
    const Drive result = drive(*controller, setup, scene, 60.0, {}, late_periods);
    EXPECT_TRUE(result.is_reached) << late_periods << ": " << result.last_reason;
    EXPECT_FALSE(result.has_contact);
    EXPECT_LE(result.max_acceleration_ratio, 1.0 + 1e-9) << late_periods;
    return result.time_s;
  };
  EXPECT_LE(time_s(4), 1.15 * time_s(0));
}

INSTANTIATE_TEST_SUITE_P(Laws, DrivesByLateOdometry,
                         ::testing::Values("dwa", "regulated_pure_pursuit", "mppi"),
                         [](const auto& info) { return std::string(info.param); });

TEST(LastCommand, CountsAsFarAsTheBaseCanHaveFollowedIt) {
  MotionLimits limits;
  limits.vx_max = 1.0;
  limits.ax_max = limits.decel_max = 1.0;
  LastCommand last(limits, 0.05);
  RobotState measured;
  measured.twist.vx = 0.1;
  EXPECT_EQ(last.motion(measured).vx, 0.1);
  last.note({0.2, 0.0, 0.0}, 0.0);
  measured.time_s = 0.05;
  EXPECT_EQ(last.motion(measured).vx, 0.2);
  last.note({1.0, 0.0, 0.0}, 0.05);
  EXPECT_DOUBLE_EQ(last.motion(measured).vx, 0.1 + LastCommand::kMaxDelay_s);
  measured.time_s = 1.0;
  EXPECT_EQ(last.motion(measured).vx, 0.1);
}

class IgnoresSidewaysNoise : public ::testing::TestWithParam<const char*> {};

// Files of users have an acc_lim_y of 0 for such robots.
TEST_P(IgnoresSidewaysNoise, OfABaseThatCannotDriveSideways) {
  ControlSetup setup = burger();
  setup.limits.ay_max = 0.0;
  const Scene scene = straight_scene(setup.footprint);
  const CostGrid grid = scene.world.grid();
  const Path path = plan_on(grid, scene.start, scene.goal, setup.footprint.inscribed_radius);
  const auto command = [&](double vy) {
    const RobotState state{scene.start, {0.0, vy, 0.0}, 0.0};
    return make_controller(GetParam(), setup)->command(state, path, grid, {}).twist;
  };
  const Twist2 quiet = command(0.0);
  const Twist2 noisy = command(-1e-3);
  EXPECT_GT(quiet.vx, 0.0);
  EXPECT_EQ(noisy.vx, quiet.vx);
  EXPECT_EQ(noisy.wz, quiet.wz);
}

INSTANTIATE_TEST_SUITE_P(Laws, IgnoresSidewaysNoise,
                         ::testing::Values("dwa", "regulated_pure_pursuit", "mppi"),
                         [](const auto& info) { return std::string(info.param); });

// What shuttles next to the goal comes no nearer, but turns to the goal's heading: only once that
// ends, too, is what is reached enough.
TEST(GoalArrival, ACarThatTurnsInItsSlotIsNotDoneYet) {
  GoalTolerance tolerance;
  tolerance.xy_goal_tolerance = 0.2;
  tolerance.yaw_goal_tolerance = 0.15;
  tolerance.fallback_time = 5.0;
  GoalArrival arrival(tolerance, false);
  const Pose2 goal{0.0, 0.0, 0.0};
  double time_s = 0.0;
  for (; time_s < 10.0; time_s += 0.1) {
    const double yaw = 0.28 - 0.01 * time_s;
    const RobotState state{{0.05, 0.0, yaw}, {}, time_s};
    ASSERT_NE(arrival.update(state, goal), ArrivalPhase::kReached) << "at " << time_s << " s";
  }
  const RobotState stuck{{0.05, 0.0, 0.18}, {}, time_s + tolerance.fallback_time};
  EXPECT_EQ(arrival.update(stuck, goal), ArrivalPhase::kReached);
}

}  // namespace
}  // namespace trident::nav::testing
