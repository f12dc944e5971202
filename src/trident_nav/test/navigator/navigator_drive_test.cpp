// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The navigator with real costmaps, planner and controller in a world of walls.
#include <gtest/gtest.h>

#include <cmath>

#include "navigator/robot_world.h"

namespace trident::nav {
namespace {

using testing::RobotWorld;

RobotWorld::Setup office() {
  RobotWorld::Setup setup;
  setup.start = {0.6, 2.0, 0.0};
  setup.mapped = {{3.0, 0.0, 3.1, 2.6}};
  return setup;
}

TEST(Navigator, DrivesAroundAWall) {
  RobotWorld world(office());
  world.navigator().set_goal({5.2, 1.0, -1.57}, 0.0);
  const NavigatorOutput output = world.drive(60.0);
  EXPECT_EQ(output.text, "Goal reached.");
  EXPECT_FALSE(world.has_touched());
  EXPECT_LT(distance(world.state().pose.x, world.state().pose.y, 5.2, 1.0), 0.1);
  EXPECT_LT(std::fabs(wrap_angle(world.state().pose.yaw + 1.57)), 0.1);
  EXPECT_TRUE(world.recoveries().empty());
}

TEST(Navigator, FindsTheOtherRouteWhereTheMapIsWrong) {
  RobotWorld::Setup setup = office();
  setup.mapped = {{3.0, 0.6, 3.1, 3.4}};
  setup.unmapped = {{3.0, 3.3, 3.1, 4.0}};
  setup.params.planner_frequency = 2.0;
  setup.start.y = 2.6;
  RobotWorld world(setup);
  world.navigator().set_goal({5.2, 2.6, 0.0}, 0.0);
  const NavigatorOutput output = world.drive(90.0);
  EXPECT_EQ(output.text, "Goal reached.");
  EXPECT_FALSE(world.has_touched());
}

TEST(Navigator, StandsWhileTheLidarIsSilentAndContinuesByItself) {
  RobotWorld world(office());
  world.navigator().set_goal({5.2, 1.0, 0.0}, 0.0);
  while (world.now_s() < 4.0) world.step();
  ASSERT_GT(world.state().twist.vx, 0.2);
  world.set_lidar_on(false);
  const Pose2 before = world.state().pose;
  while (world.now_s() < 12.0) world.step();
  EXPECT_NEAR(world.state().twist.vx, 0.0, 1e-9);
  // The limit of 0.3 s, a period of it at most, and the braking distance from 0.5 m/s.
  EXPECT_LT(distance(before.x, before.y, world.state().pose.x, world.state().pose.y),
            0.5 * 0.45 + 0.5 * 0.5 / 2.0);
  EXPECT_NE(world.waiting().find("scan"), std::string::npos) << world.waiting();
  world.set_lidar_on(true);
  EXPECT_EQ(world.drive(60.0).text, "Goal reached.");
  EXPECT_FALSE(world.has_touched());
}

TEST(Navigator, GivesUpAGoalBehindAWallThatOnlyTheLidarSees) {
  RobotWorld::Setup setup;
  setup.start = {1.0, 2.0, 0.0};
  setup.unmapped = {{3.0, 0.0, 3.1, 4.0}};
  setup.params.planner_frequency = 2.0;
  RobotWorld world(setup);
  world.navigator().set_goal({5.0, 2.0, 0.0}, 0.0);
  const NavigatorOutput output = world.drive(400.0);
  EXPECT_EQ(output.status, NavigatorStatus::kAborted);
  EXPECT_NE(output.text.find("goal (5.00, 2.00)"), std::string::npos) << output.text;
  EXPECT_FALSE(world.has_touched());
}

TEST(Navigator, GivesUpAWalledInGoalAndNamesIt) {
  RobotWorld::Setup setup = office();
  setup.mapped = {{3.0, 0.0, 3.1, 4.0}};
  RobotWorld world(setup);
  world.navigator().set_goal({5.2, 1.0, 0.0}, 0.0);
  const NavigatorOutput output = world.drive(120.0);
  EXPECT_EQ(output.status, NavigatorStatus::kAborted);
  EXPECT_EQ(output.text.rfind(
                "Failed to find a valid plan. Even after executing recovery behaviors. ", 0),
            0U);
  EXPECT_GT(output.text.size(), 100U) << output.text;
  const std::vector<std::string> all = {"conservative_reset", "rotate_recovery", "aggressive_reset",
                                        "retreat"};
  EXPECT_EQ(world.recoveries(), all);
  EXPECT_FALSE(world.has_touched());
}

}  // namespace
}  // namespace trident::nav
