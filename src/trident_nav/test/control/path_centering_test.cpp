// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "control/mppi/path_centering.h"

#include <gtest/gtest.h>

#include <cmath>

#include "control/grid_world.h"

namespace trident::nav::testing {
namespace {

constexpr double kRadius_m = 0.26;
constexpr double kDoorY_m = 2.0;

/// A wall from x = 1.95 to 2.05 with a door, which a rectangle of 0.31 m just fits through.
GridWorld door_world() {
  GridWorld world(4.0, 4.0, 0.01);
  world.fill({1.95, 0.0, 2.05, kDoorY_m - 0.185});
  world.fill({1.95, kDoorY_m + 0.185, 2.05, 4.0});
  return world;
}

Path line(const Pose2& from, const Pose2& to) {
  Path path;
  const double length_m = distance(from.x, from.y, to.x, to.y);
  const int steps = static_cast<int>(length_m / 0.025);
  const double yaw = std::atan2(to.y - from.y, to.x - from.x);
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    path.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y), yaw});
  }
  return path;
}

TEST(PathCentering, ASlantedPathLeadsStraightThroughTheMiddleOfADoor) {
  const GridWorld world = door_world();
  Path path = line({1.0, 1.3, 0.0}, {3.0, 2.8, 0.0});
  center_path(world.grid(), kRadius_m, &path);
  for (const Pose2& pose : path) {
    if (pose.x < 1.8 || pose.x > 2.1) continue;
    EXPECT_NEAR(pose.y, kDoorY_m, 0.02) << "at x " << pose.x;
    EXPECT_NEAR(pose.yaw, 0.0, 0.15) << "at x " << pose.x;
  }
}

TEST(PathCentering, TheEndsStayWhereTheyAre) {
  const GridWorld world = door_world();
  Path path = line({1.7, 2.1, 0.0}, {2.3, 1.9, 0.0});
  center_path(world.grid(), kRadius_m, &path);
  EXPECT_NEAR(path.front().y, 2.1, 1e-9);
  EXPECT_NEAR(path.back().y, 1.9, 1e-9);
}

TEST(PathCentering, NearAWallWithoutAnotherOneNothingMoves) {
  GridWorld world(4.0, 4.0, 0.01);
  world.fill({0.0, 0.0, 4.0, 1.0});
  const Path before = line({0.5, 1.2, 0.0}, {3.5, 1.2, 0.0});
  Path path = before;
  center_path(world.grid(), kRadius_m, &path);
  for (std::size_t i = 0; i < path.size(); ++i) EXPECT_EQ(path[i].y, before[i].y);
}

}  // namespace
}  // namespace trident::nav::testing
