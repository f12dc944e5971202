// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/control/progress_monitor.h"

#include <cmath>

namespace trident::nav {

bool ProgressMonitor::update(const RobotState& state) {
  const Pose2& from = reference_.pose;
  const bool has_moved =
      distance(from.x, from.y, state.pose.x, state.pose.y) >= params_.required_movement_radius ||
      std::fabs(wrap_angle(state.pose.yaw - from.yaw)) >= params_.required_movement_angle;
  if (!has_reference_ || has_moved || state.time_s < reference_.time_s) {
    reference_ = state;
    has_reference_ = true;
  }
  return state.time_s - reference_.time_s <= params_.movement_time_allowance;
}

}  // namespace trident::nav
