// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "trident_bridges/autopilot/vehicle.h"

namespace trident::bridges {

/// Moves a body that obeys its set-points for a time: a multirotor is where its reference is, but
/// for the ground; others go straight to a leg's end.
inline void obey(const Setpoint& setpoint, double step_s, VehicleState& state) {
  const Eigen::Vector3d before = state.p_world_m;
  if (setpoint.kind == Setpoint::Kind::kTrajectory) {
    state.p_world_m = setpoint.p_m;
    state.R_world_body = Eigen::AngleAxisd(setpoint.yaw, Eigen::Vector3d::UnitZ());
  } else if (setpoint.kind == Setpoint::Kind::kLeg) {
    const Eigen::Vector3d to_go = setpoint.p_m - state.p_world_m;
    const double step_m = std::min(to_go.norm(), step_s * setpoint.speed_m_s);
    if (step_m > 0.0) state.p_world_m += step_m * to_go.normalized();
  } else if (setpoint.kind == Setpoint::Kind::kDrive) {
    const double yaw = state.yaw() + step_s * setpoint.yaw_rate;
    state.R_world_body = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
    state.p_world_m +=
        step_s * setpoint.speed_m_s * Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0);
  }
  state.p_world_m.z() = std::max(state.p_world_m.z(), 0.0);
  state.v_world_m_s = (state.p_world_m - before) / step_s;
}

}  // namespace trident::bridges
