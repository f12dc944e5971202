// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/control_types.h"

#include <cmath>

namespace trident {
namespace {

// 0 for finite numbers, NaN for anything else: one comparison checks a whole state.
double taint(const Eigen::Vector3d& v) { return 0.0 * v.x() + 0.0 * v.y() + 0.0 * v.z(); }

}  // namespace

bool is_valid(const OdometryState& state) {
  const double sum = taint(state.p_world_body) + taint(state.v_body) + taint(state.w_body);
  const double squared_norm = state.R_world_body.coeffs().squaredNorm();
  return sum == 0.0 && squared_norm > 0.95 * 0.95 && squared_norm < 1.05 * 1.05;
}

bool is_valid(const TrajectoryPoint& point) {
  const double sum = taint(point.p_world) + taint(point.v_world) + taint(point.a_world) +
                     0.0 * point.yaw + 0.0 * point.yaw_rate;
  return sum == 0.0;
}

bool is_valid(const AttitudeCommand& command) {
  const double sum =
      0.0 * command.roll + 0.0 * command.pitch + 0.0 * command.yaw_rate + 0.0 * command.thrust;
  return sum == 0.0;
}

double yaw_from_quaternion(const Eigen::Quaterniond& q) {
  return std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()),
                    1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
}

}  // namespace trident
