// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/se2.h"

#include <cmath>

#include "trident_base/angle.h"

namespace trident {

SE2 SE2::from_xy_yaw(double x, double y, double yaw) { return {wrap_to_pi(yaw), {x, y}}; }

SE2 SE2::exp(const Tangent& tangent) {
  const double w = tangent[2];
  // V(w) of SE(2) with 1 - cos(w) = 2 sin^2(w / 2), which loses no digits at small angles.
  const double half_sinc = w == 0.0 ? 0.5 : std::sin(0.5 * w) / w;
  const double along = w == 0.0 ? 1.0 : std::sin(w) / w;
  const double across = 2.0 * half_sinc * half_sinc * w;  // (1 - cos(w)) / w
  return {wrap_to_pi(w),
          {along * tangent[0] - across * tangent[1], across * tangent[0] + along * tangent[1]}};
}

// Yaw is that of the x axis' projection, which is defined as long as pitch is not +-90 degrees.
SE2 SE2::projected(const SE3& T) {
  const Eigen::Vector3d x_axis = T.R * Eigen::Vector3d::UnitX();
  return {std::atan2(x_axis.y(), x_axis.x()), T.p.head<2>()};
}

SE2 SE2::operator*(const SE2& other) const {
  return {wrap_to_pi(angle + other.angle), p + rotation() * other.p};
}

Eigen::Vector2d SE2::operator*(const Eigen::Vector2d& point) const {
  return p + rotation() * point;
}

SE2 SE2::inverse() const { return {wrap_to_pi(-angle), -(rotation().transpose() * p)}; }

SE2::Tangent SE2::log() const {
  const double w = wrap_to_pi(angle);
  // The inverse of V(w): (w / 2) cot(w / 2) on the diagonal, w / 2 off it.
  const double half = 0.5 * w;
  const double along = half == 0.0 ? 1.0 : half / std::tan(half);
  return {along * p.x() + half * p.y(), along * p.y() - half * p.x(), w};
}

SE2::Adjoint SE2::adjoint() const {
  Adjoint result = Adjoint::Identity();
  result.topLeftCorner<2, 2>() = rotation();
  result(0, 2) = p.y();
  result(1, 2) = -p.x();
  return result;
}

Eigen::Matrix2d SE2::rotation() const {
  const double s = std::sin(angle);
  const double c = std::cos(angle);
  Eigen::Matrix2d result;
  result << c, -s, s, c;
  return result;
}

SE3 SE2::to_se3(double z) const { return SE3::from_xyz_rpy({p.x(), p.y(), z}, 0.0, 0.0, angle); }

}  // namespace trident
