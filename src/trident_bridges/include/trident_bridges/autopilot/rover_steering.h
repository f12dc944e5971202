// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/angle.h"
#include "trident_bridges/autopilot/vehicle.h"

namespace trident::bridges {

/// How a ground robot follows a leg.
struct RoverSteeringParams {
  double lookahead_m = 1.5;            ///< line of sight: smaller is closer to the leg
  double turn_gain_per_s = 1.5;        ///< from an error in heading to a rate of turn
  double max_turn_rate_rad_s = 1.0;    ///< about the vertical
  double acceleration_m_s2 = 0.8;      ///< with which it stops at a leg's end
  double stop_radius_m = 0.2;          ///< it stands within this of a leg's end
  double turn_in_place_rad = kPi / 3;  ///< from this error in heading it turns before it drives
};

/// Speed ahead and rate of turn.
struct Drive {
  double speed_m_s = 0.0;  ///< negative: astern
  double yaw_rate = 0.0;   ///< counter-clockwise [rad/s]
};

/// What a robot that takes speeds shall do for a set-point: along a leg by line of sight (Fossen,
/// Handbook of Marine Craft Hydrodynamics and Motion Control, 12.3), at rest for a station.
Drive steer(const Setpoint& setpoint, const VehicleState& state,
            const RoverSteeringParams& params = {});

}  // namespace trident::bridges
