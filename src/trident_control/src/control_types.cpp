// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/control_types.h"

#include <cmath>

namespace trident::control {
namespace {

// 0 for finite numbers, NaN for anything else: one comparison checks a whole state.
/// Beyond it no product of a few of them is a number any more; nothing that flies comes near.
constexpr double kLargest = 1e8;

bool is_usable(double value) { return std::abs(value) <= kLargest; }
bool is_usable(const Eigen::Vector3d& v) {
  return is_usable(v.x()) && is_usable(v.y()) && is_usable(v.z());
}
/// A quaternion's norm is 1 within 5 %.
bool is_rotation(const Eigen::Vector4d& coefficients) {
  const double squared_norm = coefficients.squaredNorm();
  return squared_norm > 0.95 * 0.95 && squared_norm < 1.05 * 1.05;
}

}  // namespace

bool is_valid(const OdometryState& state) {
  const bool is_finite =
      is_usable(state.p_world_body) && is_usable(state.v_body) && is_usable(state.w_body);
  return is_finite && is_rotation(state.R_world_body.coeffs());
}

bool is_valid(const TrajectoryPoint& point) {
  return is_usable(point.p_world) && is_usable(point.v_world) && is_usable(point.a_world) &&
         is_usable(point.yaw) && is_usable(point.yaw_rate) && is_usable(point.w_body) &&
         is_usable(point.thrust) && is_rotation(point.R_world_body.coeffs());
}

bool is_valid(const AttitudeCommand& command) {
  return is_usable(command.roll) && is_usable(command.pitch) && is_usable(command.yaw_rate) &&
         is_usable(command.thrust);
}

double yaw_from_quaternion(const Eigen::Quaterniond& q) {
  return std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()),
                    1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
}

}  // namespace trident::control
