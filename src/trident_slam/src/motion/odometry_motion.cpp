// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "odometry_motion.h"

#include <cmath>

#include "trident_base/string_util.h"

namespace trident::slam {

OdometryMotion::Step OdometryMotion::step_between(const SE2& T_odom_before,
                                                  const SE2& T_odom_now) const {
  Step step;
  step.is_stale = T_odom_before.p == T_odom_now.p && T_odom_before.angle == T_odom_now.angle;
  const SE2 moved = T_odom_before.inverse() * T_odom_now;
  if (moved.p.norm() > jump_distance_ || std::abs(moved.angle) > jump_heading_) {
    step.problem = "odometry jumped by " + number_text(moved.p.norm()) + " m, " +
                   number_text(moved.angle) + " rad, believed up to " +
                   number_text(jump_distance_) + " m, " + number_text(jump_heading_) + " rad";
  } else {
    step.T_before_now = moved;
  }
  return step;
}

OdometryMotion::Step OdometryMotion::next(const SE2& T_odom_base) {
  Step step;
  if (!T_odom_base.p.allFinite() || !std::isfinite(T_odom_base.angle)) {
    step.problem = "odometry (" + number_text(T_odom_base.p.x()) + ", " +
                   number_text(T_odom_base.p.y()) + ", " + number_text(T_odom_base.angle) +
                   ") is not finite";
    return step;
  }
  if (T_odom_base_) step = step_between(*T_odom_base_, T_odom_base);
  T_odom_base_ = T_odom_base;
  return step;
}

}  // namespace trident::slam
