// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "trident_base/se3.h"

namespace trident {

/// Rigid transform T_a_b in the plane: p_a = T_a_b * p_b. `angle` [rad] is kept in (-pi, pi] by
/// every operation here; `p` is the origin of b in a [m]. Tangent vectors are (vx [m], vy [m], w
/// [rad]).
struct SE2 {
  using Tangent = Eigen::Vector3d;  ///< (vx [m], vy [m], w [rad])
  using Adjoint = Eigen::Matrix3d;  ///< see adjoint()

  double angle = 0.0;                           ///< of b's x axis in a [rad]
  Eigen::Vector2d p = Eigen::Vector2d::Zero();  ///< origin of b in a [m]

  static SE2 identity() { return {}; }  ///< frames a and b are one
  /// Wraps `yaw` [rad] into (-pi, pi].
  static SE2 from_xy_yaw(double x, double y, double yaw);
  /// The pose after moving with the constant body twist `tangent` for unit time.
  static SE2 exp(const Tangent& tangent);
  /// The planar part of T: x, y and yaw (the heading of the body's x axis).
  static SE2 projected(const SE3& T);

  /// T_a_b * T_b_c = T_a_c.
  SE2 operator*(const SE2& other) const;
  /// Coordinates in b to coordinates in a [m].
  Eigen::Vector2d operator*(const Eigen::Vector2d& point) const;
  /// T_b_a.
  SE2 inverse() const;

  /// Inverse of `exp`, with w in (-pi, pi].
  Tangent log() const;
  /// Moves a twist from frame b to frame a: T * exp(t) == exp(T.adjoint() * t) * T.
  Adjoint adjoint() const;
  /// 2x2 rotation matrix R_a_b.
  Eigen::Matrix2d rotation() const;
  /// The same transform at height z [m], without roll and pitch.
  SE3 to_se3(double z = 0.0) const;
};

}  // namespace trident
