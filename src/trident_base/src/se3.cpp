// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/se3.h"

#include <cmath>

#include "trident_base/so3.h"

namespace trident {

SE3 SE3::exp(const Tangent& tangent) {
  const Eigen::Vector3d w = tangent.tail<3>();
  return {so3_exp(w), so3_left_jacobian(w) * tangent.head<3>()};
}

SE3::Tangent SE3::log() const {
  const Eigen::Vector3d w = so3_log(R);
  Tangent result;
  result << so3_left_jacobian_inverse(w) * p, w;
  return result;
}

SE3::Adjoint SE3::adjoint() const {
  const Eigen::Matrix3d rotation = R.toRotationMatrix();
  Adjoint result;
  result << rotation, skew(p) * rotation, Eigen::Matrix3d::Zero(), rotation;
  return result;
}

Eigen::Vector3d SE3::rpy() const {
  // At a pitch of +-90 degrees only yaw -+ roll is defined: all of it is given to roll.
  constexpr double kGimbalLock = 1e-12;
  const Eigen::Matrix3d m = R.toRotationMatrix();
  const double cos_pitch = std::hypot(m(0, 0), m(1, 0));
  const double pitch = std::atan2(-m(2, 0), cos_pitch);
  const double yaw = cos_pitch < kGimbalLock ? 0.0 : std::atan2(m(1, 0), m(0, 0));
  // Roll from what is left after undoing yaw, so that an ill-conditioned yaw is compensated.
  const double s = std::sin(yaw);
  const double c = std::cos(yaw);
  const double roll = std::atan2(s * m(0, 2) - c * m(1, 2), c * m(1, 1) - s * m(0, 1));
  return {roll, pitch, yaw};
}

Eigen::Matrix4d SE3::matrix() const {
  Eigen::Matrix4d result = Eigen::Matrix4d::Identity();
  result.topLeftCorner<3, 3>() = R.toRotationMatrix();
  result.topRightCorner<3, 1>() = p;
  return result;
}

}  // namespace trident
