// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/map_publisher.h"

#include <gtest/gtest.h>

#include <vector>

namespace trident::slam {
namespace {

nav_msgs::OccupancyGrid map_of(std::uint32_t width, std::vector<std::int8_t> cells) {
  nav_msgs::OccupancyGrid map;
  map.info.width = width;
  map.info.height = static_cast<std::uint32_t>(cells.size()) / width;
  map.info.resolution = 0.05F;
  map.info.origin.orientation.w = 1.0;
  map.data = std::move(cells);
  return map;
}

// As a subscriber does.
nav_msgs::OccupancyGrid updated(nav_msgs::OccupancyGrid map,
                                const map_msgs::OccupancyGridUpdate& update) {
  std::size_t next = 0;
  for (std::uint32_t row = 0; row < update.height; ++row) {
    for (std::uint32_t column = 0; column < update.width; ++column) {
      map.data[(update.y + row) * map.info.width + update.x + column] = update.data[next++];
    }
  }
  return map;
}

TEST(ChangedPart, IsTheSmallestRectangleOfWhatDiffers) {
  const auto before = map_of(4, {0, 0, 0, 0,  //
                                 0, 0, 0, 0,  //
                                 0, 0, 0, 0});
  const auto after = map_of(4, {0, 0, 0, 0,    //
                                0, 100, 0, 0,  //
                                0, 0, -1, 0});
  const auto update = changed_part(before, after);
  ASSERT_TRUE(update);
  EXPECT_EQ(update->x, 1);
  EXPECT_EQ(update->y, 1);
  EXPECT_EQ(update->width, 2U);
  EXPECT_EQ(update->height, 2U);
  EXPECT_EQ(update->data, (std::vector<std::int8_t>{100, 0, 0, -1}));
  EXPECT_EQ(updated(before, *update).data, after.data);
}

TEST(ChangedPart, IsEmptyForTheSameMap) {
  const auto map = map_of(2, {0, 100, -1, 0});
  EXPECT_TRUE(changed_part(map, map)->data.empty());
}

TEST(ChangedPart, CannotExpressAnotherSizeOrPlace) {
  const auto map = map_of(2, {0, 100, -1, 0});
  EXPECT_FALSE(changed_part(map, map_of(1, {0, 100, -1, 0})));
  EXPECT_FALSE(changed_part(map, map_of(2, {0, 100})));
  auto elsewhere = map;
  elsewhere.info.origin.position.x = 0.05;
  EXPECT_FALSE(changed_part(map, elsewhere));
}

}  // namespace
}  // namespace trident::slam
