// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/input_checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trident::nav {
namespace {

const ros::Time kNow(1000, 0);
const ros::Time kLast(std::numeric_limits<std::uint32_t>::max(), 999'999'999);

geometry_msgs::Pose upright() {
  geometry_msgs::Pose pose;
  pose.orientation.w = 1.0;
  return pose;
}

TEST(InputChecksTest, GoalsNameTheFieldThatIsNotLegal) {
  EXPECT_EQ(goal_problem(upright()), "");
  geometry_msgs::Pose pose = upright();
  pose.position.y = -INFINITY;
  EXPECT_EQ(goal_problem(pose), "position is (0, -inf, 0) m, legal: finite, up to +-1e+08 m");
  pose = upright();
  pose.orientation.w = 0.0;
  EXPECT_EQ(goal_problem(pose), "orientation is a quaternion of length 0, legal: 1");
  pose.orientation.z = NAN;
  EXPECT_NE(goal_problem(pose).find("orientation is a quaternion of length nan"),
            std::string::npos);
  pose = upright();
  pose.orientation.w = pose.orientation.x = std::sqrt(0.5);
  EXPECT_NE(goal_problem(pose).find("legal: 0, a turn about the z axis"), std::string::npos);
}

TEST(InputChecksTest, GoalsMayHaveAnyHeading) {
  for (double half = -3.0; half < 3.0; half += 0.1) {
    geometry_msgs::Pose pose;
    pose.orientation.z = 1.01 * std::sin(half);  // as typed with two digits
    pose.orientation.w = 1.01 * std::cos(half);
    EXPECT_EQ(goal_problem(pose), "") << half;
  }
}

TEST(InputChecksTest, OdometryNeedsAVelocityAndATime) {
  nav_msgs::Odometry message;
  message.header.stamp = kNow;
  EXPECT_EQ(odometry_problem(message, kNow), "");
  message.twist.twist.angular.z = NAN;
  EXPECT_EQ(odometry_problem(message, kNow), "angular.z is nan, legal: up to +-10000");
  message.twist.twist.angular.z = 0.0;
  message.header.stamp = kLast;
  EXPECT_NE(odometry_problem(message, kNow).find("stamp is"), std::string::npos);
}

TEST(InputChecksTest, SweepsMayNotOutlastWhatStampsCanCount) {
  sensor_msgs::LaserScan scan;
  scan.ranges.assign(360, 1.0F);
  scan.angle_increment = 0.0175F;
  scan.range_max = 5.0F;
  EXPECT_EQ(beams_problem(scan), "");
  scan.time_increment = 1e9F;
  EXPECT_NE(beams_problem(scan).find("time_increment"), std::string::npos);
  scan.time_increment = 0.0F;
  scan.range_min = -1.0F;
  EXPECT_NE(beams_problem(scan).find("range_min is -1 m"), std::string::npos);
}

sensor_msgs::PointCloud2 cloud_of(std::uint32_t points) {
  sensor_msgs::PointCloud2 cloud;
  for (const char* name : {"x", "y", "z"}) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = 4 * static_cast<std::uint32_t>(cloud.fields.size());
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  cloud.width = points;
  cloud.height = 1;
  cloud.point_step = 12;
  cloud.row_step = 12 * points;
  cloud.data.resize(cloud.row_step);
  return cloud;
}

TEST(InputChecksTest, AScanThatWasCutNamesHowManyBeamsItShouldHave) {
  sensor_msgs::LaserScan scan;
  scan.angle_min = -3.1F;
  scan.angle_max = 3.1F;
  scan.angle_increment = 0.02F;
  scan.range_min = 0.1F;
  scan.range_max = 5.0F;
  scan.ranges.assign(311, 1.0F);
  EXPECT_EQ(beams_problem(scan), "");
  scan.ranges.resize(306);  // drivers leave out a few
  EXPECT_EQ(beams_problem(scan), "");
  scan.ranges.resize(180);
  EXPECT_EQ(beams_problem(scan),
            "ranges has 180 beams, legal: 311, as angle_min, angle_max and angle_increment say");
  scan.angle_max = 0.0F;
  scan.angle_min = 0.0F;  // not given
  EXPECT_EQ(beams_problem(scan), "");
}

TEST(InputChecksTest, AScanInWhichNoBeamSaysAnythingIsABlindLidar) {
  sensor_msgs::LaserScan scan;
  scan.angle_increment = 0.02F;
  scan.range_min = 0.1F;
  scan.range_max = 5.0F;
  scan.ranges.assign(10, NAN);
  const char* const kBlind =
      "all 10 ranges are NaN or below range_min = 0.1 m, legal: at least one that is not";
  EXPECT_EQ(beams_problem(scan), kBlind);
  scan.ranges.assign(10, 0.0F);
  EXPECT_EQ(beams_problem(scan), kBlind);
  scan.ranges[3] = INFINITY;  // nothing is there
  EXPECT_EQ(beams_problem(scan), "");
  scan.ranges[3] = 2.0F;
  EXPECT_EQ(beams_problem(scan), "");
}

TEST(InputChecksTest, CloudsHoldAllPointsThatTheyAnnounce) {
  EXPECT_EQ(cloud_problem(cloud_of(0)), "");
  EXPECT_EQ(cloud_problem(cloud_of(7)), "");
  sensor_msgs::PointCloud2 cloud = cloud_of(7);
  cloud.width = cloud.height = std::numeric_limits<std::uint32_t>::max();
  EXPECT_NE(cloud_problem(cloud).find("data has 84 bytes"), std::string::npos);
  cloud = cloud_of(7);
  cloud.fields[2].offset = 9;
  EXPECT_EQ(cloud_problem(cloud), "field z has offset 9, legal: up to point_step - 4 = 8");
  cloud.fields.pop_back();
  EXPECT_EQ(cloud_problem(cloud), "fields: there is no z");
  cloud = cloud_of(7);
  cloud.fields[0].datatype = sensor_msgs::PointField::FLOAT64;
  EXPECT_EQ(cloud_problem(cloud), "field x has datatype 8, legal: 7, FLOAT32");
}

TEST(InputChecksTest, IdsFromTheFutureAreOfNow) {
  actionlib_msgs::GoalID id;
  id.id = "a goal";
  id.stamp = kLast;
  EXPECT_EQ(within_time(id, kNow).stamp, kNow);
  EXPECT_EQ(within_time(id, kNow).id, "a goal");
  EXPECT_FALSE(within_time(id, ros::Time()).stamp.isZero());
  id.stamp = ros::Time(900, 5);
  EXPECT_EQ(within_time(id, kNow).stamp, id.stamp);
  id.stamp = ros::Time();
  EXPECT_TRUE(within_time(id, kNow).stamp.isZero());
}

}  // namespace
}  // namespace trident::nav
