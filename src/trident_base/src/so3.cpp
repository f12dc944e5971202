// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/so3.h"

#include <cmath>

namespace trident {
namespace {

// Below this angle [rad] the series with their fifth term are exact to double precision.
constexpr double kSeriesAngle = 0.3;

// (angle - sin(angle)) / angle^3
double sine_remainder(double angle) {
  const double a2 = angle * angle;
  if (angle > kSeriesAngle) return (angle - std::sin(angle)) / (a2 * angle);
  return 1.0 / 6 - a2 * (1.0 / 120 - a2 * (1.0 / 5040 - a2 * (1.0 / 362880 - a2 / 39916800)));
}

// (1 - angle/2 * cot(angle/2)) / angle^2
double cotangent_remainder(double angle) {
  const double a2 = angle * angle;
  if (angle > kSeriesAngle) return (1.0 - 0.5 * angle / std::tan(0.5 * angle)) / a2;
  return 1.0 / 12 + a2 * (1.0 / 720 + a2 * (1.0 / 30240 + a2 * (1.0 / 1209600 + a2 / 47900160)));
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d result;
  result << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return result;
}

Eigen::Quaterniond so3_exp(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  const double scale = angle > 0.0 ? std::sin(0.5 * angle) / angle : 0.5;
  const Eigen::Vector3d v = scale * rotation_vector;
  return Eigen::Quaterniond(std::cos(0.5 * angle), v.x(), v.y(), v.z());
}

Eigen::Vector3d so3_log(const Eigen::Quaterniond& R) {
  // q and -q are the same rotation; the one with w >= 0 turns by at most pi.
  const double sign = R.w() < 0.0 ? -1.0 : 1.0;
  const double sine = R.vec().norm();
  if (sine == 0.0) return Eigen::Vector3d::Zero();
  return (sign * 2.0 * std::atan2(sine, sign * R.w()) / sine) * R.vec();
}

Eigen::Matrix3d so3_left_jacobian(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  // (1 - cos(angle)) / angle^2 without its cancellation.
  const double half_sinc = angle > 0.0 ? std::sin(0.5 * angle) / angle : 0.5;
  const Eigen::Matrix3d S = skew(rotation_vector);
  return Eigen::Matrix3d::Identity() + 2.0 * half_sinc * half_sinc * S +
         sine_remainder(angle) * S * S;
}

Eigen::Matrix3d so3_left_jacobian_inverse(const Eigen::Vector3d& rotation_vector) {
  const Eigen::Matrix3d S = skew(rotation_vector);
  return Eigen::Matrix3d::Identity() - 0.5 * S +
         cotangent_remainder(rotation_vector.norm()) * S * S;
}

}  // namespace trident
