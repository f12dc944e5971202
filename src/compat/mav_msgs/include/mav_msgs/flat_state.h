// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>
#include <cmath>

#include "mav_msgs/default_values.h"
#include "mav_msgs/eigen_mav_msgs.h"

/// The state of a multirotor from the flat outputs of a trajectory.
namespace mav_msgs {

/// Full state of a multirotor from its flat outputs, after D. Mellinger, "Trajectory generation
/// and control for quadrotors", PhD thesis, University of Pennsylvania, 2012, section 2.3.
/// No air drag; undefined in free fall and with the thrust along the heading.
/// @param acceleration,jerk,snap derivatives of the position, world frame.
/// @param yaw,yaw_rate,yaw_acceleration heading and its derivatives [rad, s].
/// @param magnitude_of_gravity [m/s^2].
/// @param[out] orientation body in the world.
/// @param[out] acceleration_body specific force, as an accelerometer reads it, body frame.
/// @param[out] angular_velocity_body,angular_acceleration_body body frame.
inline void EigenMavStateFromEigenTrajectoryPoint(
    const Eigen::Vector3d& acceleration, const Eigen::Vector3d& jerk, const Eigen::Vector3d& snap,
    double yaw, double yaw_rate, double yaw_acceleration, double magnitude_of_gravity,
    Eigen::Quaterniond* orientation, Eigen::Vector3d* acceleration_body,
    Eigen::Vector3d* angular_velocity_body, Eigen::Vector3d* angular_acceleration_body) {
  assert(orientation != nullptr && acceleration_body != nullptr);
  assert(angular_velocity_body != nullptr && angular_acceleration_body != nullptr);

  const Eigen::Vector3d force = acceleration + magnitude_of_gravity * Eigen::Vector3d::UnitZ();
  const double thrust = force.norm();  // per unit of mass
  const Eigen::Vector3d z = force / thrust;
  const Eigen::Vector3d heading(std::cos(yaw), std::sin(yaw), 0.0);
  const Eigen::Vector3d y = z.cross(heading).normalized();
  const Eigen::Vector3d x = y.cross(z);
  Eigen::Matrix3d R;
  R << x, y, z;
  *orientation = Eigen::Quaterniond(R);
  *acceleration_body = thrust * Eigen::Vector3d::UnitZ();

  // z' = w x z, so that the part of the jerk across z gives w about x and y.
  const double thrust_dot = z.dot(jerk);
  const Eigen::Vector3d z_dot = (jerk - thrust_dot * z) / thrust;
  *angular_velocity_body << -z_dot.dot(y), z_dot.dot(x), yaw_rate * z.z();

  // z'' = w' x z + w x z' follows from the snap by the same steps.
  const Eigen::Vector3d w = R * *angular_velocity_body;
  const Eigen::Vector3d across = (snap - 2.0 * thrust_dot * z_dot) / thrust - w.cross(z_dot);
  *angular_acceleration_body << -across.dot(y), across.dot(x), yaw_acceleration * z.z();
}

/// The same with the default gravity.
inline void EigenMavStateFromEigenTrajectoryPoint(
    const Eigen::Vector3d& acceleration, const Eigen::Vector3d& jerk, const Eigen::Vector3d& snap,
    double yaw, double yaw_rate, double yaw_acceleration, Eigen::Quaterniond* orientation,
    Eigen::Vector3d* acceleration_body, Eigen::Vector3d* angular_velocity_body,
    Eigen::Vector3d* angular_acceleration_body) {
  EigenMavStateFromEigenTrajectoryPoint(acceleration, jerk, snap, yaw, yaw_rate, yaw_acceleration,
                                        kGravity, orientation, acceleration_body,
                                        angular_velocity_body, angular_acceleration_body);
}

/// The state at a trajectory point; a fully actuated vehicle (DOF6) takes the point's own attitude.
inline void EigenMavStateFromEigenTrajectoryPoint(const EigenTrajectoryPoint& flat_state,
                                                  double magnitude_of_gravity,
                                                  EigenMavState* mav_state) {
  assert(mav_state != nullptr);
  mav_state->position_W = flat_state.position_W;
  mav_state->velocity_W = flat_state.velocity_W;
  if (flat_state.degrees_of_freedom == MavActuation::DOF4) {
    EigenMavStateFromEigenTrajectoryPoint(
        flat_state.acceleration_W, flat_state.jerk_W, flat_state.snap_W, flat_state.getYaw(),
        flat_state.getYawRate(), flat_state.getYawAcc(), magnitude_of_gravity,
        &mav_state->orientation_W_B, &mav_state->acceleration_B, &mav_state->angular_velocity_B,
        &mav_state->angular_acceleration_B);
    return;
  }
  const Eigen::Quaterniond q_B_W = flat_state.orientation_W_B.conjugate();
  const Eigen::Vector3d gravity_W(0.0, 0.0, magnitude_of_gravity);
  mav_state->orientation_W_B = flat_state.orientation_W_B;
  mav_state->acceleration_B = q_B_W * (flat_state.acceleration_W + gravity_W);
  mav_state->angular_velocity_B = q_B_W * flat_state.angular_velocity_W;
  mav_state->angular_acceleration_B = q_B_W * flat_state.angular_acceleration_W;
}

inline void EigenMavStateFromEigenTrajectoryPoint(const EigenTrajectoryPoint& flat_state,
                                                  EigenMavState* mav_state) {
  EigenMavStateFromEigenTrajectoryPoint(flat_state, kGravity, mav_state);
}

}  // namespace mav_msgs
