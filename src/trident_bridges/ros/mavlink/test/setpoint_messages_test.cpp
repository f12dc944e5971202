// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/mavlink/setpoint_messages.h"

#include <gtest/gtest.h>

#include "trident_base/angle.h"

namespace trident::bridges {
namespace {

/// A frame at (10, 20, 1) of the world, its x to the north.
SE3 northern_frame() { return SE3::from_xyz_rpy({10.0, 20.0, 1.0}, 0.0, 0.0, 0.5 * kPi); }

Setpoint full_setpoint() {
  Setpoint setpoint;
  setpoint.p_m = {10.0, 25.0, 4.0};
  setpoint.p_from_m = {10.0, 20.0, 1.0};
  setpoint.v_m_s = {0.0, 2.0, 0.5};
  setpoint.a_m_s2 = {1.0, 0.0, 0.0};
  setpoint.yaw = 0.5 * kPi;
  setpoint.yaw_rate = 0.3;
  setpoint.speed_m_s = 1.5;
  setpoint.thrust = 0.5;
  setpoint.w_body_rad_s = {0.1, 0.2, 0.3};
  return setpoint;
}

TEST(SetpointMessages, PlacesAndDirectionsAreThoseOfTheControllersFrame) {
  const Setpoint local = in_frame(full_setpoint(), northern_frame().inverse());
  EXPECT_LT((local.p_m - Eigen::Vector3d(5.0, 0.0, 3.0)).norm(), 1e-9);
  EXPECT_LT(local.p_from_m.norm(), 1e-9);
  EXPECT_LT((local.v_m_s - Eigen::Vector3d(2.0, 0.0, 0.5)).norm(), 1e-9);
  EXPECT_LT((local.a_m_s2 - Eigen::Vector3d(0.0, -1.0, 0.0)).norm(), 1e-9);
  EXPECT_NEAR(wrap_to_pi(local.yaw), 0.0, 1e-9);
  EXPECT_NEAR(local.R_world_body.angularDistance(
                  Eigen::Quaterniond(Eigen::AngleAxisd(-0.5 * kPi, Eigen::Vector3d::UnitZ()))),
              0.0, 1e-9);
  EXPECT_EQ(local.w_body_rad_s, full_setpoint().w_body_rad_s) << "of the body, whatever the frame";
}

TEST(SetpointMessages, ATrajectoryHasOnePointAtItsStamp) {
  const auto header = setpoint_header(SimTime{2'020'000'000}, "odom");
  const auto message = to_trajectory(full_setpoint(), header);
  EXPECT_EQ(message.header.stamp, ros::Time(2, 20'000'000));
  EXPECT_EQ(message.header.frame_id, "odom");
  ASSERT_EQ(message.points.size(), 1U);
  const auto& point = message.points[0];
  EXPECT_EQ(point.time_from_start, ros::Duration(0));
  EXPECT_EQ(point.transforms.at(0).translation.y, 25.0);
  EXPECT_NEAR(point.transforms.at(0).rotation.z, std::sqrt(0.5), 1e-12);
  EXPECT_EQ(point.velocities.at(0).linear.z, 0.5);
  EXPECT_EQ(point.velocities.at(0).angular.z, 0.3);
  EXPECT_EQ(point.accelerations.at(0).linear.x, 1.0);
}

TEST(SetpointMessages, ThrustIsAShareOfAllRotorsAndNeverMoreThanAll) {
  Setpoint setpoint = full_setpoint();
  const auto header = setpoint_header({}, "");
  EXPECT_DOUBLE_EQ(to_attitude_thrust(setpoint, 24.0, header).thrust.z, 12.0);
  EXPECT_DOUBLE_EQ(to_rate_thrust(setpoint, 24.0, header).thrust.z, 12.0);
  EXPECT_DOUBLE_EQ(to_rate_thrust(setpoint, 24.0, header).angular_rates.y, 0.2);
  setpoint.thrust = 7.0;
  EXPECT_DOUBLE_EQ(to_attitude_thrust(setpoint, 24.0, header).thrust.z, 24.0);
  setpoint.thrust = -1.0;
  EXPECT_DOUBLE_EQ(to_attitude_thrust(setpoint, 24.0, header).thrust.z, 0.0);
}

TEST(SetpointMessages, AVesselGetsItsLegItsSpeedAndItsStation) {
  const auto header = setpoint_header(SimTime{40'000'000}, "usv1/world");
  const auto path = to_path(full_setpoint(), header);
  ASSERT_EQ(path.poses.size(), 2U);
  EXPECT_EQ(path.poses[0].pose.position.y, 20.0);
  EXPECT_EQ(path.poses[1].pose.position.y, 25.0);
  EXPECT_EQ(path.poses[1].header.frame_id, "usv1/world");
  EXPECT_EQ(to_cruise(full_setpoint(), header).twist.linear.x, 1.5);
  EXPECT_EQ(to_velocity(full_setpoint(), header).twist.angular.z, 0.3);
  const auto station = to_station(full_setpoint(), header);
  EXPECT_EQ(station.pose.position.x, 10.0);
  EXPECT_NEAR(station.pose.orientation.w, std::sqrt(0.5), 1e-12);
}

}  // namespace
}  // namespace trident::bridges
