// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "control/scene.h"
#include "trident_base/angle.h"
#include "trident_base/random_stream.h"

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

}  // namespace
}  // namespace trident::nav::testing
