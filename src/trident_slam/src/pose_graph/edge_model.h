// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "trident_base/se2.h"
#include "trident_base/se3.h"

namespace trident::slam {

/// A pose as the optimiser keeps it: with a rotation matrix.
template <int kSpace>
struct MatrixPose {
  Eigen::Matrix<double, kSpace, kSpace> R = Eigen::Matrix<double, kSpace, kSpace>::Identity();
  Eigen::Matrix<double, kSpace, 1> p = Eigen::Matrix<double, kSpace, 1>::Zero();

  MatrixPose operator*(const MatrixPose& other) const { return {R * other.R, p + R * other.p}; }
  MatrixPose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

/// The measurement model of an edge in the plane or in space: error, Jacobians, steps.
/// With T_ab = T_a^-1 T_b and Z the measurement, the error is e = log(Z^-1 T_ab), and
///   de/d(step of b) = J,   de/d(step of a) = -J Ad(T_ab^-1),
/// where a step d moves T to T * exp(d) and J is the inverse right Jacobian of the group at e.
template <class Group>
struct EdgeModel;

template <>
struct EdgeModel<SE2> {
  static constexpr int kSpace = 2;
  using Pose = MatrixPose<2>;
  using Tangent = SE2::Tangent;
  using Matrix = Eigen::Matrix3d;

  static Pose from_group(const SE2& T) { return {T.rotation(), T.p}; }
  static SE2 to_group(const Pose& T);
  static Tangent log(const Pose& T);
  /// The same, and J.
  static Tangent log(const Pose& T, Matrix& J);
  static Matrix inverse_adjoint(const Pose& T);
  /// T with a step to first order: (v, w) adds R v to the origin and turns by w.
  static Pose moved(const Pose& T, const Tangent& step);
};

template <>
struct EdgeModel<SE3> {
  static constexpr int kSpace = 3;
  using Pose = MatrixPose<3>;
  using Tangent = SE3::Tangent;
  using Matrix = Matrix6d;

  static Pose from_group(const SE3& T) { return {T.R.toRotationMatrix(), T.p}; }
  static SE3 to_group(const Pose& T);
  static Tangent log(const Pose& T);
  static Tangent log(const Pose& T, Matrix& J);
  static Matrix inverse_adjoint(const Pose& T);
  static Pose moved(const Pose& T, const Tangent& step);
};

}  // namespace trident::slam
