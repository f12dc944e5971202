// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Where scans leave a direction open, the wheels measure how far the robot has moved.
#include <gtest/gtest.h>

#include <cmath>

#include "graph_slam/polygon_world.h"
#include "trident_slam/graph_slam_2d.h"

namespace trident::slam {
namespace {

/// A corridor of 2.4 m whose ends a scanner of 5.6 m does not see.
PolygonWorld corridor() {
  PolygonWorld world;
  world.add_box(-20.0, -1.2, 20.0, 1.2);
  return world;
}

LaserScan seen(const PolygonWorld& world, const SE2& T, std::uint64_t index) {
  LaserScan scan = world.scan(T, index);
  scan.range_max = 5.6;
  for (float& range : scan.ranges) range = 0.01F * std::round(100.0F * range);  // as a SICK reports
  return scan;
}

TEST(BareCorridor, ARobotWhoseWheelsStandDoesNotCreepAlongIt) {
  const PolygonWorld world = corridor();
  GraphSlam2d slam;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const SE2 T = slam.add_scan(seen(world, SE2::from_xy_yaw(0.3, 0.0, 0.0), i), {}).T_map_base;
    ASSERT_NEAR(T.p.x(), 0.0, 0.002) << "scan " << i;
  }
}

TEST(BareCorridor, RightOdometryIsKeptAlongIt) {
  const PolygonWorld world = corridor();
  GraphSlam2d slam;
  for (std::uint64_t i = 0; i < 240; ++i) {
    const SE2 moved = SE2::from_xy_yaw(0.05 * static_cast<double>(i), 0.0, 0.0);
    const SE2 T =
        slam.add_scan(seen(world, SE2::from_xy_yaw(-6.0, 0.0, 0.0) * moved, i), moved).T_map_base;
    ASSERT_NEAR(T.p.x(), moved.p.x(), 0.002) << "scan " << i;
  }
}

}  // namespace
}  // namespace trident::slam
