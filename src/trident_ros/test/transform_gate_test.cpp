// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "trident_ros/transform_input.h"

namespace trident::ros_utils {
namespace {

class TransformGateTest : public testing::Test {
 protected:
  std::string add(double stamp_s, double x, const ros::Time& now = {}) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = "odom";
    transform.header.stamp.fromSec(stamp_s);
    transform.child_frame_id = "base";
    transform.transform.translation.x = x;
    transform.transform.rotation.w = 1.0;
    return gate_.add(transform, "test", false, now);
  }
  bool is_known(double stamp_s) {
    return buffer_.canTransform("odom", "base", ros::Time().fromSec(stamp_s));
  }

  tf2::BufferCore buffer_;
  TransformGate gate_{buffer_};
};

TEST_F(TransformGateTest, NumbersThatAreNoneStayOut) {
  EXPECT_EQ(add(10.0, 1.0), "");
  EXPECT_NE(add(10.1, std::nan("")), "");
  EXPECT_NE(add(10.1, 1e308), "");
  EXPECT_EQ(buffer_.lookupTransform("odom", "base", ros::Time(0)).transform.translation.x, 1.0);
}

TEST_F(TransformGateTest, AStampFromAnotherCenturyStaysOut) {
  EXPECT_EQ(add(1000.0, 1.0, ros::Time(1000, 0)), "");
  EXPECT_NE(add(4e9, 2.0, ros::Time(1000, 0)), "");
  EXPECT_NE(add(1e6, 2.0, ros::Time(1000, 0)), "");
  geometry_msgs::TransformStamped fixed;
  fixed.header.frame_id = "odom";
  fixed.header.stamp.sec = 4'294'967'295U;
  fixed.child_frame_id = "base";
  fixed.transform.rotation.w = 1.0;
  EXPECT_NE(gate_.add(fixed, "test", true, ros::Time(1000, 0)), "");
  EXPECT_EQ(add(1000.1, 1.0, ros::Time(1000, 0)), "");
  EXPECT_TRUE(is_known(1000.05));
}

TEST_F(TransformGateTest, AStampAnHourAheadIsBelievedOnlyUntilTheOthersContinue) {
  EXPECT_EQ(add(1000.0, 1.0), "");
  EXPECT_EQ(add(4600.0, 2.0), "");
  int refused = 0;
  for (int i = 1; i <= 2 * TransformGate::kPatience; ++i) {
    refused += add(1000.0 + 0.1 * i, 1.0).empty() ? 0 : 1;
  }
  EXPECT_EQ(refused, TransformGate::kPatience - 1);
  EXPECT_TRUE(is_known(1003.55));
}

}  // namespace
}  // namespace trident::ros_utils
