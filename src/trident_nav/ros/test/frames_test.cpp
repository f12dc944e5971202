// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/frames.h"

#include <gtest/gtest.h>

namespace trident::nav {
namespace {

geometry_msgs::TransformStamped at(double stamp_s, double x) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "odom";
  transform.header.stamp.fromSec(stamp_s);
  transform.child_frame_id = "base_link";
  transform.transform.translation.x = x;
  transform.transform.rotation.w = 1.0;
  return transform;
}

TEST(FramesTest, ALateTransformIsNamedWithItsAgeAndTheLimit) {
  tf2::BufferCore buffer;
  buffer.setTransform(at(10.0, 2.0), "test");
  std::string problem;
  double stamp_s = 0.0;
  const auto pose = newest_pose(buffer, "odom", "base_link", 10.2, 0.3, &problem, &stamp_s);
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->x, 2.0);
  EXPECT_NEAR(stamp_s, 10.0, 1e-9);
  EXPECT_FALSE(newest_pose(buffer, "odom", "base_link", 11.5, 0.3, &problem));
  EXPECT_EQ(problem,
            "the newest transform from base_link to odom is 1.5 s old, transform_tolerance is "
            "0.3 s");
}

TEST(FramesTest, AMissingTransformIsNamedWithBothFrames) {
  tf2::BufferCore buffer;
  buffer.setTransform(at(10.0, 2.0), "test");
  std::string problem;
  EXPECT_FALSE(newest_pose(buffer, "map", "base_link", 10.2, 0.3, &problem));
  EXPECT_NE(problem.find("there is no transform from base_link to map"), std::string::npos);
}

TEST(FramesTest, AStaticTransformHasNoAge) {
  tf2::BufferCore buffer;
  buffer.setTransform(at(0.0, 1.0), "test", true);
  std::string problem;
  double stamp_s = 0.0;
  EXPECT_TRUE(newest_pose(buffer, "odom", "base_link", 1e6, 0.3, &problem, &stamp_s));
  EXPECT_DOUBLE_EQ(stamp_s, 1e6);
}

}  // namespace
}  // namespace trident::nav
