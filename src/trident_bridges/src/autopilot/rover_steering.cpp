// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/rover_steering.h"

#include <algorithm>
#include <cmath>

namespace trident::bridges {
namespace {

Drive along_leg(const Setpoint& setpoint, const VehicleState& state,
                const RoverSteeringParams& params) {
  const Eigen::Vector2d to_go = (setpoint.p_m - state.p_world_m).head<2>();
  const double distance_m = to_go.norm();
  if (distance_m <= params.stop_radius_m) return {};
  const Eigen::Vector2d leg = (setpoint.p_m - setpoint.p_from_m).head<2>();
  double course = std::atan2(to_go.y(), to_go.x());
  // Near the end, behind it, or where the leg has no length, the end itself is aimed at.
  const bool is_on_leg =
      leg.norm() > params.lookahead_m && leg.dot(to_go) > 0.0 && distance_m > params.lookahead_m;
  if (is_on_leg) {
    const Eigen::Vector2d along = leg.normalized();
    const double left_m = along.y() * to_go.x() - along.x() * to_go.y();
    course = std::atan2(along.y(), along.x()) - std::atan(left_m / params.lookahead_m);
  }
  const double error = angle_difference(course, state.yaw());
  Drive drive;
  drive.yaw_rate = std::clamp(params.turn_gain_per_s * error, -params.max_turn_rate_rad_s,
                              params.max_turn_rate_rad_s);
  if (std::abs(error) >= params.turn_in_place_rad) return drive;
  const double braking_m_s = std::sqrt(2.0 * params.acceleration_m_s2 * distance_m);
  drive.speed_m_s = std::min(setpoint.speed_m_s, braking_m_s) * std::cos(error);
  return drive;
}

}  // namespace

Drive steer(const Setpoint& setpoint, const VehicleState& state,
            const RoverSteeringParams& params) {
  if (setpoint.kind == Setpoint::Kind::kLeg) return along_leg(setpoint, state, params);
  if (setpoint.kind != Setpoint::Kind::kDrive) return {};
  return {setpoint.speed_m_s, setpoint.yaw_rate};
}

}  // namespace trident::bridges
