// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/console.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <vector>

#include "mav_msgs/Actuators.h"
#include "mav_msgs/AttitudeThrust.h"
#include "mav_msgs/RateThrust.h"
#include "mav_msgs/RollPitchYawrateThrust.h"
#include "mav_msgs/TorqueThrust.h"
#include "mav_msgs/eigen_mav_msgs.h"

/// Reading messages into their Eigen counterparts.
namespace mav_msgs {

namespace internal {

inline Eigen::VectorXd vectorFromArray(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// At rest at the present position and orientation.
inline void clearDerivatives(EigenTrajectoryPoint* point) {
  point->velocity_W.setZero();
  point->acceleration_W.setZero();
  point->jerk_W.setZero();
  point->snap_W.setZero();
  point->angular_velocity_W.setZero();
  point->angular_acceleration_W.setZero();
}

}  // namespace internal

/// Quaternions are normalized as quaternionFromMsg() does, here and below.
inline void eigenAttitudeThrustFromMsg(const AttitudeThrust& msg,
                                       EigenAttitudeThrust* attitude_thrust) {
  assert(attitude_thrust != nullptr);
  attitude_thrust->attitude = quaternionFromMsg(msg.attitude);
  attitude_thrust->thrust = vector3FromMsg(msg.thrust);
}

/// Vectors get the lengths of the message's arrays.
inline void eigenActuatorsFromMsg(const Actuators& msg, EigenActuators* actuators) {
  assert(actuators != nullptr);
  actuators->angles = internal::vectorFromArray(msg.angles);
  actuators->angular_velocities = internal::vectorFromArray(msg.angular_velocities);
  actuators->normalized = internal::vectorFromArray(msg.normalized);
}

/// Nothing is checked.
inline void eigenRateThrustFromMsg(const RateThrust& msg, EigenRateThrust* rate_thrust) {
  assert(rate_thrust != nullptr);
  rate_thrust->angular_rates = vector3FromMsg(msg.angular_rates);
  rate_thrust->thrust = vector3FromMsg(msg.thrust);
}

/// Nothing is checked.
inline void eigenTorqueThrustFromMsg(const TorqueThrust& msg, EigenTorqueThrust* torque_thrust) {
  assert(torque_thrust != nullptr);
  torque_thrust->torque = vector3FromMsg(msg.torque);
  torque_thrust->thrust = vector3FromMsg(msg.thrust);
}

/// Nothing is checked.
inline void eigenRollPitchYawrateThrustFromMsg(
    const RollPitchYawrateThrust& msg, EigenRollPitchYawrateThrust* roll_pitch_yawrate_thrust) {
  assert(roll_pitch_yawrate_thrust != nullptr);
  *roll_pitch_yawrate_thrust =
      EigenRollPitchYawrateThrust(msg.roll, msg.pitch, msg.yaw_rate, vector3FromMsg(msg.thrust));
}

/// Frames are not looked at: the pose is taken for one in the world, the twist for one in the body.
inline void eigenOdometryFromMsg(const nav_msgs::Odometry& msg, EigenOdometry* odometry) {
  assert(odometry != nullptr);
  using RowMajor6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  odometry->timestamp_ns = static_cast<int64_t>(msg.header.stamp.toNSec());
  odometry->position_W = vector3FromPointMsg(msg.pose.pose.position);
  odometry->orientation_W_B = quaternionFromMsg(msg.pose.pose.orientation);
  odometry->velocity_B = vector3FromMsg(msg.twist.twist.linear);
  odometry->angular_velocity_B = vector3FromMsg(msg.twist.twist.angular);
  odometry->pose_covariance_ = Eigen::Map<const RowMajor6>(msg.pose.covariance.data());
  odometry->twist_covariance_ = Eigen::Map<const RowMajor6>(msg.twist.covariance.data());
}

/// A point at rest; time_from_start_ns is left as it is.
inline void eigenTrajectoryPointFromTransformMsg(const geometry_msgs::TransformStamped& msg,
                                                 EigenTrajectoryPoint* trajectory_point) {
  assert(trajectory_point != nullptr);
  internal::clearDerivatives(trajectory_point);
  trajectory_point->timestamp_ns = static_cast<int64_t>(msg.header.stamp.toNSec());
  trajectory_point->position_W = vector3FromMsg(msg.transform.translation);
  trajectory_point->orientation_W_B = quaternionFromMsg(msg.transform.rotation);
}

/// Leaves the times of the point as they are: a bare pose has none.
inline void eigenTrajectoryPointFromPoseMsg(const geometry_msgs::Pose& msg,
                                            EigenTrajectoryPoint* trajectory_point) {
  assert(trajectory_point != nullptr);
  internal::clearDerivatives(trajectory_point);
  trajectory_point->position_W = vector3FromPointMsg(msg.position);
  trajectory_point->orientation_W_B = quaternionFromMsg(msg.orientation);
}

/// A point at rest; time_from_start_ns is left as it is.
inline void eigenTrajectoryPointFromPoseMsg(const geometry_msgs::PoseStamped& msg,
                                            EigenTrajectoryPoint* trajectory_point) {
  eigenTrajectoryPointFromPoseMsg(msg.pose, trajectory_point);
  trajectory_point->timestamp_ns = static_cast<int64_t>(msg.header.stamp.toNSec());
}

/// Missing velocities or accelerations become zero; only the first joint is read.
inline void eigenTrajectoryPointFromMsg(const trajectory_msgs::MultiDOFJointTrajectoryPoint& msg,
                                        EigenTrajectoryPoint* trajectory_point) {
  assert(trajectory_point != nullptr);
  if (msg.transforms.empty()) {
    ROS_ERROR("mav_msgs: a trajectory point has no transform; the point is left as it was");
    return;
  }
  if (msg.transforms.size() > 1) {
    ROS_WARN("mav_msgs: a trajectory point has %zu transforms, only the first is used",
             msg.transforms.size());
  }
  internal::clearDerivatives(trajectory_point);
  trajectory_point->time_from_start_ns = msg.time_from_start.toNSec();
  trajectory_point->position_W = vector3FromMsg(msg.transforms[0].translation);
  trajectory_point->orientation_W_B = quaternionFromMsg(msg.transforms[0].rotation);
  if (!msg.velocities.empty()) {
    trajectory_point->velocity_W = vector3FromMsg(msg.velocities[0].linear);
    trajectory_point->angular_velocity_W = vector3FromMsg(msg.velocities[0].angular);
  }
  if (!msg.accelerations.empty()) {
    trajectory_point->acceleration_W = vector3FromMsg(msg.accelerations[0].linear);
    trajectory_point->angular_acceleration_W = vector3FromMsg(msg.accelerations[0].angular);
  }
}

namespace internal {

template <typename Container>
void pointsFromMsg(const trajectory_msgs::MultiDOFJointTrajectory& msg, Container* trajectory) {
  assert(trajectory != nullptr);
  trajectory->clear();
  for (const auto& msg_point : msg.points) {
    trajectory->emplace_back();
    eigenTrajectoryPointFromMsg(msg_point, &trajectory->back());
  }
}

}  // namespace internal

/// Replaces the trajectory; a point without a transform becomes a default one.
inline void eigenTrajectoryPointVectorFromMsg(const trajectory_msgs::MultiDOFJointTrajectory& msg,
                                              EigenTrajectoryPointVector* trajectory) {
  internal::pointsFromMsg(msg, trajectory);
}

/// The same into a deque.
inline void eigenTrajectoryPointDequeFromMsg(const trajectory_msgs::MultiDOFJointTrajectory& msg,
                                             EigenTrajectoryPointDeque* trajectory) {
  internal::pointsFromMsg(msg, trajectory);
}

}  // namespace mav_msgs
