// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/message_checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trident::ros_utils {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(MessageChecks, StampsThatRosCannotSubtract) {
  EXPECT_EQ(stamp_problem(ros::Time(), ros::Time()), "");
  EXPECT_EQ(stamp_problem(ros::Time(1'800'000'000, 0), ros::Time(1'800'000'100, 0)), "");
  for (const std::uint32_t sec : {2'147'483'648U, 4'000'000'000U, 4'294'967'295U}) {
    EXPECT_NE(stamp_problem(ros::Time(sec, 0), ros::Time()), "") << sec;
  }
  ros::Time too_many_ns;
  too_many_ns.nsec = 4'294'967'295U;
  EXPECT_EQ(stamp_problem(too_many_ns, ros::Time()),
            "stamp has 4294967295 ns, legal: below 1000000000");
}

TEST(MessageChecks, AStampDaysAheadOfTheClock) {
  EXPECT_EQ(stamp_problem(ros::Time(1100, 0), ros::Time(1000, 0)), "");
  EXPECT_EQ(stamp_problem(ros::Time(1'000'000, 0), ros::Time(1000, 0)),
            "stamp is 999000.000 s ahead of the clock, legal: up to 86400 s");
  EXPECT_EQ(stamp_problem(ros::Time(1'000'000, 0), ros::Time()), "");
}

TEST(MessageChecks, NumbersThatAreNone) {
  EXPECT_EQ(point_problem(1e7, -1e7, 0.0, "p"), "");
  for (const double bad : {kNan, kInf, -kInf, 1e308, -1e9}) {
    EXPECT_NE(point_problem(0.0, bad, 0.0, "p"), "") << bad;
    EXPECT_NE(number_problem(bad, 100.0, "angle"), "") << bad;
  }
  EXPECT_EQ(number_problem(kNan, 100.0, "angle"), "angle is nan, legal: up to +-100");
}

TEST(MessageChecks, TransformsThatABufferCannotKeep) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "odom";
  transform.child_frame_id = "base";
  EXPECT_EQ(transform_problem(transform), "rotation is a quaternion of length 0, legal: 1");
  transform.transform.rotation.w = 1.0;
  EXPECT_EQ(transform_problem(transform), "");
  transform.transform.translation.y = kNan;
  EXPECT_NE(transform_problem(transform), "");
  transform.transform.translation.y = 0.0;
  transform.child_frame_id = "odom";
  EXPECT_EQ(transform_problem(transform), "both frames are the same");
  transform.child_frame_id = "";
  EXPECT_EQ(transform_problem(transform), "a frame without a name");
}

TEST(MessageChecks, ScansOfNoScanner) {
  sensor_msgs::LaserScan scan;
  scan.angle_increment = 0.1F;
  scan.range_max = 10.0F;
  EXPECT_EQ(scan_problem(scan), "ranges: no beam, legal: at least 1");
  scan.ranges.assign(100, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(scan_problem(scan), "");
  scan.time_increment = std::numeric_limits<float>::quiet_NaN();  // unknown
  EXPECT_EQ(scan_problem(scan), "");
  scan.time_increment = 1e30F;
  EXPECT_NE(scan_problem(scan).find("legal: a sweep of up to 60 s"), std::string::npos);
  scan.time_increment = 0.0F;
  scan.angle_min = 3.4e38F;
  EXPECT_NE(scan_problem(scan).find("angle_min"), std::string::npos);
}

TEST(MessageChecks, WhatAStrangerSentIsQuotedShort) {
  EXPECT_EQ(quoted("a\n\x1b[31mb"), "a??[31mb");
  EXPECT_EQ(quoted(std::string(50'000, 'x')).size(), 203U);
}

}  // namespace
}  // namespace trident::ros_utils
