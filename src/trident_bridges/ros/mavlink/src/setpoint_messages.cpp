// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/mavlink/setpoint_messages.h"

#include <algorithm>
#include <cmath>

namespace trident::bridges {
namespace {

geometry_msgs::Vector3 to_vector(const Eigen::Vector3d& v) {
  geometry_msgs::Vector3 result;
  result.x = v.x();
  result.y = v.y();
  result.z = v.z();
  return result;
}

geometry_msgs::Point to_point(const Eigen::Vector3d& p) {
  geometry_msgs::Point result;
  result.x = p.x();
  result.y = p.y();
  result.z = p.z();
  return result;
}

geometry_msgs::Quaternion to_quaternion(const Eigen::Quaterniond& q) {
  geometry_msgs::Quaternion result;
  result.x = q.x();
  result.y = q.y();
  result.z = q.z();
  result.w = q.w();
  return result;
}

geometry_msgs::Quaternion of_yaw(double yaw) {
  return to_quaternion(Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())));
}

geometry_msgs::Vector3 thrust_of(const Setpoint& setpoint, double max_thrust_N) {
  return to_vector({0.0, 0.0, max_thrust_N * std::clamp(setpoint.thrust, 0.0, 1.0)});
}

}  // namespace

std_msgs::Header setpoint_header(SimTime stamp, const std::string& frame) {
  std_msgs::Header header;
  header.stamp.fromNSec(static_cast<std::uint64_t>(std::max<std::int64_t>(stamp.ns, 0)));
  header.frame_id = frame;
  return header;
}

Setpoint in_frame(const Setpoint& setpoint, const SE3& T_frame_world) {
  const Eigen::Vector3d east = T_frame_world.R * Eigen::Vector3d::UnitX();
  Setpoint result = setpoint;
  result.p_m = T_frame_world * setpoint.p_m;
  result.p_from_m = T_frame_world * setpoint.p_from_m;
  result.v_m_s = T_frame_world.R * setpoint.v_m_s;
  result.a_m_s2 = T_frame_world.R * setpoint.a_m_s2;
  result.R_world_body = T_frame_world.R * setpoint.R_world_body;
  result.yaw = setpoint.yaw + std::atan2(east.y(), east.x());
  return result;
}

trajectory_msgs::MultiDOFJointTrajectory to_trajectory(const Setpoint& setpoint,
                                                       const std_msgs::Header& header) {
  trajectory_msgs::MultiDOFJointTrajectory message;
  message.header = header;
  message.joint_names = {"base_link"};
  message.points.resize(1);
  auto& point = message.points.front();
  geometry_msgs::Transform place;
  place.translation = to_vector(setpoint.p_m);
  place.rotation = of_yaw(setpoint.yaw);
  geometry_msgs::Twist velocity, acceleration;
  velocity.linear = to_vector(setpoint.v_m_s);
  velocity.angular.z = setpoint.yaw_rate;
  acceleration.linear = to_vector(setpoint.a_m_s2);
  point.transforms = {place};
  point.velocities = {velocity};
  point.accelerations = {acceleration};
  return message;
}

mav_msgs::AttitudeThrust to_attitude_thrust(const Setpoint& setpoint, double max_thrust_N,
                                            const std_msgs::Header& header) {
  mav_msgs::AttitudeThrust message;
  message.header = header;
  message.attitude = to_quaternion(setpoint.R_world_body);
  message.thrust = thrust_of(setpoint, max_thrust_N);
  return message;
}

mav_msgs::RateThrust to_rate_thrust(const Setpoint& setpoint, double max_thrust_N,
                                    const std_msgs::Header& header) {
  mav_msgs::RateThrust message;
  message.header = header;
  message.angular_rates = to_vector(setpoint.w_body_rad_s);
  message.thrust = thrust_of(setpoint, max_thrust_N);
  return message;
}

geometry_msgs::TwistStamped to_velocity(const Setpoint& setpoint, const std_msgs::Header& header) {
  geometry_msgs::TwistStamped message;
  message.header = header;
  message.twist.linear.x = setpoint.speed_m_s;
  message.twist.angular.z = setpoint.yaw_rate;
  return message;
}

geometry_msgs::TwistStamped to_cruise(const Setpoint& setpoint, const std_msgs::Header& header) {
  geometry_msgs::TwistStamped message;
  message.header = header;
  message.twist.linear.x = setpoint.speed_m_s;
  return message;
}

nav_msgs::Path to_path(const Setpoint& setpoint, const std_msgs::Header& header) {
  nav_msgs::Path message;
  message.header = header;
  for (const Eigen::Vector3d& place : {setpoint.p_from_m, setpoint.p_m}) {
    geometry_msgs::PoseStamped pose;
    pose.header = header;
    pose.pose.position = to_point(place);
    pose.pose.orientation.w = 1.0;
    message.poses.push_back(pose);
  }
  return message;
}

geometry_msgs::PoseStamped to_station(const Setpoint& setpoint, const std_msgs::Header& header) {
  geometry_msgs::PoseStamped message;
  message.header = header;
  message.pose.position = to_point(setpoint.p_m);
  message.pose.orientation = of_yaw(setpoint.yaw);
  return message;
}

}  // namespace trident::bridges
