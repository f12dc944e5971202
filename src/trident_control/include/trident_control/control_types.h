// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

namespace trident::control {

/// Measured state. The twist is in the body frame, as nav_msgs/Odometry carries it.
struct OdometryState {
  Eigen::Vector3d p_world_body = Eigen::Vector3d::Zero();            ///< [m]
  Eigen::Quaterniond R_world_body = Eigen::Quaterniond::Identity();  ///< unit quaternion
  Eigen::Vector3d v_body = Eigen::Vector3d::Zero();                  ///< [m/s]
  Eigen::Vector3d w_body = Eigen::Vector3d::Zero();                  ///< [rad/s]
};

/// How much of a multirotor a reference leaves to its controller.
enum class ControlLevel : std::int64_t {
  position,  ///< position, velocity, acceleration and heading are followed
  attitude,  ///< attitude, yaw rate and thrust
  rates,     ///< body rates and thrust
  idle,      ///< the rotors stand
};

/// Reference of a position controller, or of a part of it.
struct TrajectoryPoint {
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d v_world = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d a_world = Eigen::Vector3d::Zero();  ///< [m/s^2]
  double yaw = 0.0;                                   ///< [rad]
  double yaw_rate = 0.0;                              ///< [rad/s]
  ControlLevel level = ControlLevel::position;        ///< which of the fields count
  /// Of level attitude: unit quaternion. Unaligned, so that a point is a row of doubles.
  Eigen::Quaternion<double, Eigen::DontAlign> R_world_body =
      Eigen::Quaternion<double, Eigen::DontAlign>::Identity();
  Eigen::Vector3d w_body = Eigen::Vector3d::Zero();  ///< of level rates [rad/s]
  double thrust = 0.0;                               ///< of both, along body z [N]
};

/// Reference of an attitude controller: roll and pitch angle, yaw rate, collective thrust.
struct AttitudeCommand {
  double roll = 0.0;      ///< [rad]
  double pitch = 0.0;     ///< [rad]
  double yaw_rate = 0.0;  ///< [rad/s]
  double thrust = 0.0;    ///< along body z [N]
};

/// Outcome of one control step. On anything but `ok` the output span has not been written.
enum class ControlStatus {
  ok,                 ///< the output has been written
  invalid_state,      ///< a number that is not usable, or a quaternion that is not a rotation
  invalid_reference,  ///< a number that is not usable
  wrong_rotor_count,  ///< the output span is not as long as the vehicle has rotors
};

/// Whether all numbers are usable: finite, and none beyond 1e8; the quaternion's norm is 1 within
/// 5 %.
bool is_valid(const OdometryState& state);
/// Whether all numbers are finite, and none is beyond 1e8; the quaternion as that of a state.
bool is_valid(const TrajectoryPoint& point);
/// The same for a command.
bool is_valid(const AttitudeCommand& command);

/// Heading of a rotation: the angle that a z-y-x Euler decomposition gives last [rad, -pi..pi].
/// Scale of the quaternion is not corrected for, as in RotorS.
double yaw_from_quaternion(const Eigen::Quaterniond& R_world_body);

}  // namespace trident::control
