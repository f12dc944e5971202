// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/mavlink/static_frames.h"

#include <gtest/gtest.h>

#include <limits>

namespace trident::bridges {
namespace {

geometry_msgs::TransformStamped transform(const std::string& parent, const std::string& child,
                                          double x) {
  geometry_msgs::TransformStamped result;
  result.header.frame_id = parent;
  result.child_frame_id = child;
  result.transform.translation.x = x;
  result.transform.rotation.w = 1.0;
  return result;
}

tf2_msgs::TFMessage message_of(std::vector<geometry_msgs::TransformStamped> transforms) {
  tf2_msgs::TFMessage message;
  message.transforms = std::move(transforms);
  return message;
}

TEST(StaticFrames, AChainLeadsToTheWorldOnceItIsWhole) {
  StaticFrames frames("world");
  EXPECT_EQ(frames.add(message_of({transform("ugv1/map", "ugv1/odom", 2.0)})), "");
  EXPECT_FALSE(frames.world_from("ugv1/odom"));
  EXPECT_EQ(frames.add(message_of({transform("/world", "ugv1/map", 1.0)})), "");
  ASSERT_TRUE(frames.world_from("ugv1/odom"));
  EXPECT_DOUBLE_EQ(frames.world_from("/ugv1/odom")->p.x(), 3.0);
}

TEST(StaticFrames, AVehiclesOwnNameOfTheWorldIsTheWorld) {
  const StaticFrames frames("world");
  EXPECT_TRUE(frames.world_from("world"));
  EXPECT_TRUE(frames.world_from("usv1/world"));
  EXPECT_FALSE(frames.world_from("underworld"));
}

TEST(StaticFrames, ALoopLeadsNowhere) {
  StaticFrames frames("world");
  frames.add(message_of({transform("a", "b", 1.0), transform("b", "a", 1.0)}));
  EXPECT_FALSE(frames.world_from("a"));
}

TEST(StaticFrames, ABadTransformIsNamedAndLeftOut) {
  StaticFrames frames("world");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string problem =
      frames.add(message_of({transform("world", "a", nan), transform("world", "b", 1.0)}));
  EXPECT_NE(problem, "");
  EXPECT_FALSE(frames.world_from("a"));
  EXPECT_TRUE(frames.world_from("b"));
}

}  // namespace
}  // namespace trident::bridges
