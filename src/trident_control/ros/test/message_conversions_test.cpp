// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/message_conversions.h"

#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/serialization.h>

#include <cmath>

namespace trident::control {
namespace {

nav_msgs::Odometry some_odometry() {
  nav_msgs::Odometry message;
  message.header.seq = 7;
  message.header.stamp = ros::Time(12, 345);
  message.header.frame_id = "world";
  message.child_frame_id = "UAV1/odometry_sensor1";
  message.pose.pose.position.x = 1.0;
  message.pose.pose.position.y = 2.0;
  message.pose.pose.position.z = 3.0;
  message.pose.pose.orientation.x = 0.1;
  message.pose.pose.orientation.y = 0.2;
  message.pose.pose.orientation.z = 0.3;
  message.pose.pose.orientation.w = 0.9;
  message.twist.twist.linear.x = 4.0;
  message.twist.twist.linear.z = 6.0;
  message.twist.twist.angular.y = 8.0;
  message.twist.twist.angular.z = 9.0;
  message.pose.covariance.fill(-1.0);
  message.twist.covariance.fill(-2.0);
  return message;
}

std::vector<std::uint8_t> bytes_of(const nav_msgs::Odometry& message) {
  const ros::SerializedMessage serialized = ros::serialization::serializeMessage(message);
  return {serialized.message_start, serialized.buf.get() + serialized.num_bytes};
}

TEST(ParseOdometry, reads_what_roscpp_writes) {
  const auto odometry = parse_odometry(bytes_of(some_odometry()));
  ASSERT_TRUE(odometry);
  EXPECT_EQ(odometry->stamp, ros::Time(12, 345));
  EXPECT_EQ(odometry->state.p_world_body, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(odometry->state.R_world_body.coeffs(), Eigen::Vector4d(0.1, 0.2, 0.3, 0.9));
  EXPECT_EQ(odometry->state.v_body, Eigen::Vector3d(4, 0, 6));
  EXPECT_EQ(odometry->state.w_body, Eigen::Vector3d(0, 8, 9));
}

TEST(ParseOdometry, frame_names_may_have_any_length) {
  nav_msgs::Odometry message = some_odometry();
  for (const std::size_t length : {0u, 1u, 15u, 16u, 1000u}) {
    message.header.frame_id.assign(length, 'a');
    message.child_frame_id.assign(1000 - length, 'b');
    const auto odometry = parse_odometry(bytes_of(message));
    ASSERT_TRUE(odometry);
    EXPECT_EQ(odometry->state.w_body.z(), 9.0);
  }
}

TEST(ParseOdometry, refuses_bytes_that_end_early_anywhere) {
  const std::vector<std::uint8_t> bytes = bytes_of(some_odometry());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_FALSE(parse_odometry({bytes.data(), length})) << length;
  }
}

TEST(ParseOdometry, refuses_a_string_length_beyond_the_end) {
  std::vector<std::uint8_t> bytes = bytes_of(some_odometry());
  for (std::size_t i = 12; i < 16; ++i) bytes[i] = 0xff;
  EXPECT_FALSE(parse_odometry(bytes));
}

TEST(ToStampedOdometry, gives_what_parsing_the_bytes_gives) {
  const auto parsed = parse_odometry(bytes_of(some_odometry()));
  const StampedOdometry converted = to_stamped_odometry(some_odometry());
  ASSERT_TRUE(parsed);
  EXPECT_EQ(converted.stamp, parsed->stamp);
  EXPECT_EQ(converted.state.p_world_body, parsed->state.p_world_body);
  EXPECT_EQ(converted.state.R_world_body.coeffs(), parsed->state.R_world_body.coeffs());
  EXPECT_EQ(converted.state.v_body, parsed->state.v_body);
  EXPECT_EQ(converted.state.w_body, parsed->state.w_body);
}

TEST(ToTrajectoryPoint, takes_the_yaw_of_a_tilted_pose) {
  const Eigen::Quaterniond q = Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitX());
  geometry_msgs::Pose pose;
  pose.position.y = -4.0;
  pose.orientation.w = q.w();
  pose.orientation.x = q.x();
  pose.orientation.y = q.y();
  pose.orientation.z = q.z();
  const TrajectoryPoint point = to_trajectory_point(pose);
  EXPECT_NEAR(point.yaw, 0.8, 1e-12);
  EXPECT_EQ(point.p_world, Eigen::Vector3d(0, -4, 0));
  EXPECT_EQ(point.yaw_rate, 0.0);
}

TEST(ToSetpoints, reads_feed_forward_where_there_is_some) {
  trajectory_msgs::MultiDOFJointTrajectory message;
  message.points.resize(2);
  for (auto& point : message.points) point.transforms.resize(1);
  message.points[1].time_from_start = ros::Duration(1.5);
  message.points[1].velocities.resize(1);
  message.points[1].velocities[0].linear.x = 1.0;
  message.points[1].velocities[0].angular.z = 0.4;
  message.points[1].accelerations.resize(1);
  message.points[1].accelerations[0].linear.y = 2.0;
  std::vector<TimedSetpoint> setpoints(5);
  EXPECT_FALSE(to_setpoints(message, setpoints));
  ASSERT_EQ(setpoints.size(), 2u);
  EXPECT_EQ(setpoints[0].point.v_world, Eigen::Vector3d::Zero());
  EXPECT_EQ(setpoints[1].time_from_start.ns, 1'500'000'000);
  EXPECT_EQ(setpoints[1].point.v_world, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(setpoints[1].point.a_world, Eigen::Vector3d(0, 2, 0));
  EXPECT_EQ(setpoints[1].point.yaw_rate, 0.4);
}

TEST(ToSetpoints, names_the_point_without_a_transform) {
  trajectory_msgs::MultiDOFJointTrajectory message;
  message.points.resize(3);
  message.points[0].transforms.resize(1);
  std::vector<TimedSetpoint> setpoints;
  EXPECT_EQ(to_setpoints(message, setpoints), 1u);
}

TEST(ToSimTime, keeps_every_nanosecond) {
  EXPECT_EQ(to_sim_time(ros::Time(4'000'000'000u, 999'999'999u)).ns, 4'000'000'000'999'999'999);
  EXPECT_EQ(to_sim_time(ros::Duration(-1, 500'000'000)).ns, -500'000'000);
}

TEST(ToAttitudeCommand, thrust_is_the_z_component) {
  mav_msgs::RollPitchYawrateThrust message;
  message.roll = 0.1;
  message.pitch = 0.2;
  message.yaw_rate = 0.3;
  message.thrust.x = 99.0;
  message.thrust.z = 15.0;
  const AttitudeCommand command = to_attitude_command(message);
  EXPECT_EQ(command.roll, 0.1);
  EXPECT_EQ(command.pitch, 0.2);
  EXPECT_EQ(command.yaw_rate, 0.3);
  EXPECT_EQ(command.thrust, 15.0);
}

TEST(MessageConversions, an_attitude_with_thrust_is_a_reference_without_position) {
  mav_msgs::AttitudeThrust message;
  message.attitude.w = 0.8;
  message.attitude.y = 0.6;
  message.thrust.z = 12.5;
  const TrajectoryPoint point = to_trajectory_point(message);
  EXPECT_EQ(point.level, ControlLevel::attitude);
  EXPECT_EQ(point.R_world_body.w(), 0.8);
  EXPECT_EQ(point.R_world_body.y(), 0.6);
  EXPECT_EQ(point.thrust, 12.5);
  EXPECT_TRUE(is_valid(point));
  message.attitude.w = 0.0;
  EXPECT_FALSE(is_valid(to_trajectory_point(message))) << "no rotation";
}

TEST(MessageConversions, rates_with_thrust_are_a_reference_without_attitude) {
  mav_msgs::RateThrust message;
  message.angular_rates.x = 1.5;
  message.thrust.z = 9.0;
  const TrajectoryPoint point = to_trajectory_point(message);
  EXPECT_EQ(point.level, ControlLevel::rates);
  EXPECT_EQ(point.w_body, Eigen::Vector3d(1.5, 0.0, 0.0));
  EXPECT_EQ(point.thrust, 9.0);
}

}  // namespace
}  // namespace trident::control
