// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// MAVLink's frames (NED: north, east, down; FRD: forward, right, down) and ours (ENU: east, north,
/// up; FLU: forward, left, up; REP-103, REP-147). Each conversion is its own inverse, and stands
/// here alone.
#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "trident_base/angle.h"

namespace trident::bridges::mavlink {

/// Pose (position, rotation) or twist (linear, angular) covariance.
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A vector of the world: NED to ENU, or ENU to NED.
inline Eigen::Vector3d swap_world(const Eigen::Vector3d& v) { return {v.y(), v.x(), -v.z()}; }

/// A vector of a body: FRD to FLU, or FLU to FRD.
inline Eigen::Vector3d swap_body(const Eigen::Vector3d& v) { return {v.x(), -v.y(), -v.z()}; }

/// A rotation from body to world: that of FRD in NED to that of FLU in ENU, or the reverse.
inline Eigen::Quaterniond swap_attitude(const Eigen::Quaterniond& q_world_body) {
  // The half turn about x + y swaps the worlds, that about x the bodies.
  const double half = std::sqrt(0.5);
  const Eigen::Quaterniond world(0.0, half, half, 0.0), body(0.0, 1.0, 0.0, 0.0);
  return world * q_world_body * body;
}

/// A heading: clockwise from north to counterclockwise from east, or the reverse. [rad] in
/// (-pi, pi].
inline double swap_yaw(double yaw_rad) { return wrap_to_pi(0.5 * kPi - yaw_rad); }

/// A yaw rate or another turn about the vertical. [rad/s]
inline double swap_yaw_rate(double rate_rad_s) { return -rate_rad_s; }

/// Covariance of two vectors of the world, such as those of a pose in NED.
inline Matrix6 swap_world_covariance(const Matrix6& covariance) {
  Matrix6 swap = Matrix6::Zero();
  for (const int at : {0, 3}) {
    swap(at, at + 1) = swap(at + 1, at) = 1.0;
    swap(at + 2, at + 2) = -1.0;
  }
  return swap * covariance * swap.transpose();
}

/// Covariance of two vectors of a body, such as those of a twist in FRD.
inline Matrix6 swap_body_covariance(const Matrix6& covariance) {
  Eigen::Matrix<double, 6, 1> signs;
  signs << 1.0, -1.0, -1.0, 1.0, -1.0, -1.0;
  return signs.asDiagonal() * covariance * signs.asDiagonal();
}

}  // namespace trident::bridges::mavlink
