// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_maps_ros/map_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "trident_base/error.h"

namespace trident::maps {
namespace {

nav_msgs::OccupancyGrid map_of_two() {
  nav_msgs::OccupancyGrid map;
  map.info.width = 2;
  map.info.height = 1;
  map.info.resolution = 0.05F;
  map.info.origin.position.x = 1.0;
  map.info.origin.orientation.w = 1.0;
  map.data = {0, 100};
  return map;
}

std::string problem_of(const nav_msgs::OccupancyGrid& map) {
  try {
    from_map_message(map);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(MapMessages, ThereAndBack) {
  const OccupancyGrid grid = from_map_message(map_of_two());
  EXPECT_EQ(grid.resolution, 0.05);
  EXPECT_EQ(grid.T_map_origin.p.x(), 1.0);
  EXPECT_EQ(to_map_message(grid, {}).data, map_of_two().data);
}

TEST(MapMessages, AMapOfAnotherSizeThanItSaysIsRefused) {
  nav_msgs::OccupancyGrid bad = map_of_two();
  bad.data.push_back(0);
  EXPECT_EQ(problem_of(bad), "map: 3 cells, legal: width x height, 2 x 1, at least 1 x 1");
  bad = map_of_two();
  bad.info.width = bad.info.height = std::numeric_limits<std::uint32_t>::max();
  EXPECT_NE(problem_of(bad), "");
  bad = map_of_two();
  bad.info.resolution = 0.0F;
  EXPECT_EQ(problem_of(bad), "map: resolution 0 m, legal: 1e-04 to 1000 m");
  bad.info.resolution = 1e-40F;
  EXPECT_NE(problem_of(bad).find("resolution"), std::string::npos);
  bad = map_of_two();
  bad.info.origin.position.y = std::nan("");
  EXPECT_NE(problem_of(bad).find("pose: position (1, nan) m"), std::string::npos);
}

TEST(MapMessages, APoseWithoutAnOrientationIsRefused) {
  geometry_msgs::Pose pose;
  EXPECT_THROW(from_pose_message(pose), Error);
  pose.orientation.w = 1.0;
  EXPECT_EQ(from_pose_message(pose).angle, 0.0);
  pose.position.x = 1e308;
  EXPECT_THROW(from_pose_message(pose), Error);
}

}  // namespace
}  // namespace trident::maps
