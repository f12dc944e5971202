// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/console.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <string>
#include <vector>

#include "mav_msgs/Actuators.h"
#include "mav_msgs/AttitudeThrust.h"
#include "mav_msgs/RateThrust.h"
#include "mav_msgs/RollPitchYawrateThrust.h"
#include "mav_msgs/TorqueThrust.h"
#include "mav_msgs/eigen_mav_msgs.h"

/// Writing messages from their Eigen counterparts. The header of a written message is the
/// caller's, save where a time stamp is part of the source.
namespace mav_msgs {

namespace internal {

inline std::vector<double> arrayFromVector(const Eigen::VectorXd& values) {
  return {values.data(), values.data() + values.size()};
}

}  // namespace internal

/// Arrays get the lengths of the vectors.
inline void msgActuatorsFromEigen(const EigenActuators& actuators, Actuators* msg) {
  assert(msg != nullptr);
  msg->angles = internal::arrayFromVector(actuators.angles);
  msg->angular_velocities = internal::arrayFromVector(actuators.angular_velocities);
  msg->normalized = internal::arrayFromVector(actuators.normalized);
}

/// The quaternion is written as it is, here and below.
inline void msgAttitudeThrustFromEigen(const EigenAttitudeThrust& attitude_thrust,
                                       AttitudeThrust* msg) {
  assert(msg != nullptr);
  quaternionEigenToMsg(attitude_thrust.attitude, &msg->attitude);
  vectorEigenToMsg(attitude_thrust.thrust, &msg->thrust);
}

/// Nothing is checked.
inline void msgRateThrustFromEigen(const EigenRateThrust& rate_thrust, RateThrust* msg) {
  assert(msg != nullptr);
  vectorEigenToMsg(rate_thrust.angular_rates, &msg->angular_rates);
  vectorEigenToMsg(rate_thrust.thrust, &msg->thrust);
}

/// Nothing is checked.
inline void msgTorqueThrustFromEigen(const EigenTorqueThrust& torque_thrust, TorqueThrust* msg) {
  assert(msg != nullptr);
  vectorEigenToMsg(torque_thrust.torque, &msg->torque);
  vectorEigenToMsg(torque_thrust.thrust, &msg->thrust);
}

/// Nothing is checked.
inline void msgRollPitchYawrateThrustFromEigen(
    const EigenRollPitchYawrateThrust& roll_pitch_yawrate_thrust, RollPitchYawrateThrust* msg) {
  assert(msg != nullptr);
  msg->roll = roll_pitch_yawrate_thrust.roll;
  msg->pitch = roll_pitch_yawrate_thrust.pitch;
  msg->yaw_rate = roll_pitch_yawrate_thrust.yaw_rate;
  vectorEigenToMsg(roll_pitch_yawrate_thrust.thrust, &msg->thrust);
}

/// Writes the stamp unless it is unknown; leaves the covariances alone.
inline void msgOdometryFromEigen(const EigenOdometry& odometry, nav_msgs::Odometry* msg) {
  assert(msg != nullptr);
  if (odometry.timestamp_ns >= 0) {
    msg->header.stamp.fromNSec(static_cast<uint64_t>(odometry.timestamp_ns));
  }
  pointEigenToMsg(odometry.position_W, &msg->pose.pose.position);
  quaternionEigenToMsg(odometry.orientation_W_B, &msg->pose.pose.orientation);
  vectorEigenToMsg(odometry.velocity_B, &msg->twist.twist.linear);
  vectorEigenToMsg(odometry.angular_velocity_B, &msg->twist.twist.angular);
}

/// Position, orientation and stamp only.
inline void msgPoseStampedFromEigenTrajectoryPoint(const EigenTrajectoryPoint& trajectory_point,
                                                   geometry_msgs::PoseStamped* msg) {
  assert(msg != nullptr);
  if (trajectory_point.timestamp_ns >= 0) {
    msg->header.stamp.fromNSec(static_cast<uint64_t>(trajectory_point.timestamp_ns));
  }
  pointEigenToMsg(trajectory_point.position_W, &msg->pose.position);
  quaternionEigenToMsg(trajectory_point.orientation_W_B, &msg->pose.orientation);
}

/// One transform, velocity and acceleration. The message has no place for jerk and snap.
inline void msgMultiDofJointTrajectoryPointFromEigen(
    const EigenTrajectoryPoint& trajectory_point,
    trajectory_msgs::MultiDOFJointTrajectoryPoint* msg) {
  assert(msg != nullptr);
  msg->time_from_start.fromNSec(trajectory_point.time_from_start_ns);
  msg->transforms.resize(1);
  msg->velocities.resize(1);
  msg->accelerations.resize(1);
  vectorEigenToMsg(trajectory_point.position_W, &msg->transforms[0].translation);
  quaternionEigenToMsg(trajectory_point.orientation_W_B, &msg->transforms[0].rotation);
  vectorEigenToMsg(trajectory_point.velocity_W, &msg->velocities[0].linear);
  vectorEigenToMsg(trajectory_point.angular_velocity_W, &msg->velocities[0].angular);
  vectorEigenToMsg(trajectory_point.acceleration_W, &msg->accelerations[0].linear);
  vectorEigenToMsg(trajectory_point.angular_acceleration_W, &msg->accelerations[0].angular);
}

namespace internal {

template <typename Container>
void msgFromPoints(const Container& trajectory, const std::string& link_name,
                   trajectory_msgs::MultiDOFJointTrajectory* msg) {
  assert(msg != nullptr);
  if (trajectory.empty()) {
    ROS_ERROR("mav_msgs: the trajectory has no point; the message is left as it was");
    return;
  }
  msg->joint_names.assign(1, link_name);
  msg->points.clear();
  for (const EigenTrajectoryPoint& point : trajectory) {
    msg->points.emplace_back();
    msgMultiDofJointTrajectoryPointFromEigen(point, &msg->points.back());
  }
}

}  // namespace internal

/// Replaces joint names and points. An empty trajectory is an error in the log, and changes
/// nothing.
inline void msgMultiDofJointTrajectoryFromEigen(const EigenTrajectoryPointVector& trajectory,
                                                const std::string& link_name,
                                                trajectory_msgs::MultiDOFJointTrajectory* msg) {
  internal::msgFromPoints(trajectory, link_name, msg);
}

/// The same for the joint "base_link".
inline void msgMultiDofJointTrajectoryFromEigen(const EigenTrajectoryPointVector& trajectory,
                                                trajectory_msgs::MultiDOFJointTrajectory* msg) {
  internal::msgFromPoints(trajectory, "base_link", msg);
}

/// The same of a deque.
inline void msgMultiDofJointTrajectoryFromEigen(const EigenTrajectoryPointDeque& trajectory,
                                                const std::string& link_name,
                                                trajectory_msgs::MultiDOFJointTrajectory* msg) {
  internal::msgFromPoints(trajectory, link_name, msg);
}

/// The same of a deque for the joint "base_link".
inline void msgMultiDofJointTrajectoryFromEigen(const EigenTrajectoryPointDeque& trajectory,
                                                trajectory_msgs::MultiDOFJointTrajectory* msg) {
  internal::msgFromPoints(trajectory, "base_link", msg);
}

/// A trajectory of one point.
inline void msgMultiDofJointTrajectoryFromEigen(const EigenTrajectoryPoint& trajectory_point,
                                                const std::string& link_name,
                                                trajectory_msgs::MultiDOFJointTrajectory* msg) {
  internal::msgFromPoints(EigenTrajectoryPointVector{trajectory_point}, link_name, msg);
}

/// A trajectory of one point for the joint "base_link".
inline void msgMultiDofJointTrajectoryFromEigen(const EigenTrajectoryPoint& trajectory_point,
                                                trajectory_msgs::MultiDOFJointTrajectory* msg) {
  msgMultiDofJointTrajectoryFromEigen(trajectory_point, "base_link", msg);
}

/// A trajectory of one way-point: a position [m, world] and a yaw [rad], at rest.
inline void msgMultiDofJointTrajectoryFromPositionYaw(
    const Eigen::Vector3d& position, double yaw, trajectory_msgs::MultiDOFJointTrajectory* msg) {
  EigenTrajectoryPoint point;
  point.position_W = position;
  point.setFromYaw(yaw);
  msgMultiDofJointTrajectoryFromEigen(point, msg);
}

}  // namespace mav_msgs
