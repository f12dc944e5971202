// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

namespace trident {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Rigid transform T_a_b: takes coordinates in frame b to coordinates in frame a (p_a = T_a_b *
/// p_b). `R` is a unit quaternion, `p` the origin of b in a [m]. Tangent vectors are (v [m], w
/// [rad]): the translational part first.
struct SE3 {
  using Tangent = Vector6d;  ///< (v [m], w [rad])
  using Adjoint = Matrix6d;  ///< see adjoint()

  /// R_a_b, of unit length; products drift, so callers normalize.
  Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< origin of b in a [m]

  static SE3 identity() { return {}; }  ///< frames a and b are one
  /// Fixed-axis roll, pitch, yaw [rad] as URDF and SDF use them: R = Rz(yaw) Ry(pitch) Rx(roll).
  static SE3 from_xyz_rpy(const Eigen::Vector3d& p, double roll, double pitch, double yaw) {
    using Eigen::AngleAxisd;
    using Eigen::Vector3d;
    return {Eigen::Quaterniond(AngleAxisd(yaw, Vector3d::UnitZ()) *
                               AngleAxisd(pitch, Vector3d::UnitY()) *
                               AngleAxisd(roll, Vector3d::UnitX())),
            p};
  }
  /// The pose after moving with the constant body twist `tangent` for unit time.
  static SE3 exp(const Tangent& tangent);

  /// T_a_b * T_b_c = T_a_c. The quaternion is not normalized.
  SE3 operator*(const SE3& other) const { return {R * other.R, p + R * other.p}; }
  /// Coordinates in b to coordinates in a [m].
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const { return p + R * point; }
  /// T_b_a; of a quaternion that is not of unit length it is not the inverse.
  SE3 inverse() const {
    const Eigen::Quaterniond Ri = R.conjugate();
    return {Ri, -(Ri * p)};
  }

  /// Inverse of `exp`; the rotational part has a length in [0, pi].
  Tangent log() const;
  /// Moves a twist from frame b to frame a: T * exp(t) == exp(T.adjoint() * t) * T.
  Adjoint adjoint() const;
  /// (roll, pitch, yaw) [rad], the inverse of `from_xyz_rpy`; pitch in [-pi/2, pi/2]. At pitch
  /// +-pi/2, where only roll -+ yaw is defined, yaw is 0.
  Eigen::Vector3d rpy() const;
  /// 4x4 homogeneous matrix.
  Eigen::Matrix4d matrix() const;
};

}  // namespace trident
