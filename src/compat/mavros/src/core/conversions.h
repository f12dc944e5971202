// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Vectors and rotations between messages of ROS (ENU, FLU) and of MAVLink (NED, FRD).
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/Vector3.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "trident_base/angle.h"
#include "trident_base/se3.h"
#include "trident_bridges/mavlink/frames.h"
#include "trident_bridges/mavlink/whole_number.h"

namespace trident::mavros {

using bridges::mavlink::to_whole;

/// A vector of a message of ROS.
template <class Vector>
Eigen::Vector3d to_eigen(const Vector& v) {
  return {v.x, v.y, v.z};
}
/// Writes a vector into a message of ROS.
template <class Vector>
void assign(Vector& to, const Eigen::Vector3d& v) {
  to.x = v.x();
  to.y = v.y();
  to.z = v.z();
}
/// A rotation of a message of ROS. A zero one, as of a message that nobody filled, is the identity.
inline Eigen::Quaterniond to_rotation(const geometry_msgs::Quaternion& q) {
  const Eigen::Quaterniond result(q.w, q.x, q.y, q.z);
  constexpr double kZero = 1e-6;
  return result.norm() < kZero ? Eigen::Quaterniond::Identity() : result.normalized();
}
/// Writes a rotation into a message of ROS.
inline void assign_rotation(geometry_msgs::Quaternion& to, const Eigen::Quaterniond& q) {
  to.w = q.w();
  to.x = q.x();
  to.y = q.y();
  to.z = q.z();
}
/// Writes a rotation into the field q of a message of MAVLink: w, x, y, z. By the message: a packed
/// field binds to no reference.
template <class Payload>
void assign_q(Payload& to, const Eigen::Quaterniond& q) {
  to.q[0] = static_cast<float>(q.w());
  to.q[1] = static_cast<float>(q.x());
  to.q[2] = static_cast<float>(q.y());
  to.q[3] = static_cast<float>(q.z());
}
/// Rotation from body to world of roll, pitch and yaw [rad].
inline Eigen::Quaterniond from_euler(double roll, double pitch, double yaw) {
  return SE3::from_xyz_rpy(Eigen::Vector3d::Zero(), roll, pitch, yaw).R;
}
/// Roll, pitch and yaw [rad] of a rotation from body to world.
inline Eigen::Vector3d to_euler(const Eigen::Quaterniond& q) {
  return SE3{q, Eigen::Vector3d::Zero()}.rpy();
}
/// Angle of body x from the world's x, counterclockwise [rad].
inline double yaw_of(const Eigen::Quaterniond& q) { return to_euler(q).z(); }

/// A diagonal covariance of three values, row by row.
template <class Array>
void assign_diagonal(Array& to, double variance) {
  constexpr std::size_t kRows = 3;
  for (std::size_t i = 0; i < kRows; ++i) to[i * (kRows + 1)] = variance;
}

/// The upper triangle of a 6 x 6 matrix as MAVLink has it, row by row. NaN in the first one: not
/// known, all zero.
template <class Field>
bridges::mavlink::Matrix6 from_upper_triangle(const Field& field) {
  bridges::mavlink::Matrix6 result = bridges::mavlink::Matrix6::Zero();
  if (std::isnan(field[0])) return result;
  std::size_t at = 0;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) result(i, j) = result(j, i) = field[at++];
  }
  return result;
}
/// The reverse.
template <class Field>
void to_upper_triangle(const bridges::mavlink::Matrix6& matrix, Field& field) {
  std::size_t at = 0;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) field[at++] = static_cast<float>(matrix(i, j));
  }
}
/// A 6 x 6 covariance of a message of ROS.
template <class Array>
bridges::mavlink::Matrix6 to_matrix6(const Array& array) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(array.data());
}
/// Writes a 6 x 6 covariance into a message of ROS.
template <class Array>
void assign_matrix6(Array& to, const bridges::mavlink::Matrix6& matrix) {
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(to.data()) = matrix;
}

}  // namespace trident::mavros
