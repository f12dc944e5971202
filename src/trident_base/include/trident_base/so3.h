// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

namespace trident {

// The rotation group and its tangent space. Rotation vectors are axis * angle [rad].
// Formulas: Sola, Deray, Atchuthan, "A micro Lie theory for state estimation in robotics", 2018,
// appendix B; series are used near zero, where the closed forms lose their digits.

/// The skew-symmetric matrix with skew(a) * b = a x b.
Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/// Rotation vector -> unit quaternion.
Eigen::Quaterniond so3_exp(const Eigen::Vector3d& rotation_vector);

/// Unit quaternion -> rotation vector with length in [0, pi].
Eigen::Vector3d so3_log(const Eigen::Quaterniond& R);

/// J with so3_exp(r + dr) ~= so3_exp(J * dr) * so3_exp(r).
Eigen::Matrix3d so3_left_jacobian(const Eigen::Vector3d& rotation_vector);

/// Inverse of `so3_left_jacobian`; the rotation vector must be shorter than 2 pi.
Eigen::Matrix3d so3_left_jacobian_inverse(const Eigen::Vector3d& rotation_vector);

}  // namespace trident
