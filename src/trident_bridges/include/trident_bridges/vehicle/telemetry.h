// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "trident_base/sim_time.h"
#include "trident_base/utc_clock.h"
#include "trident_bridges/autopilot/autopilot.h"
#include "trident_bridges/mavlink/message.h"
#include "trident_bridges/mavlink/vehicles.h"
#include "trident_bridges/vehicle/geo_frame.h"

namespace trident::bridges::mavlink {

/// What sensors say besides the state that the autopilot uses; NaN: nobody says it.
struct VehicleReadings {
  Eigen::Vector3d w_body_rad_s = Eigen::Vector3d::Zero();       ///< FLU
  double voltage_V = std::numeric_limits<double>::quiet_NaN();  ///< of the battery
  double current_A = std::numeric_limits<double>::quiet_NaN();  ///< out of the battery
};

/// All that telemetry is made of.
struct TelemetrySource {
  Address self;                     ///< of the vehicle
  VehicleKind kind;                 ///< decides MAV_TYPE
  AutopilotFlavour flavour;         ///< decides MAV_AUTOPILOT
  const Autopilot& autopilot;       ///< modes, mission, home
  const VehicleState& state;        ///< the newest
  const VehicleReadings& readings;  ///< the newest
  const GeoFrame& geo;              ///< the world on the earth
  const UtcClock& clock;            ///< of the world
  SimTime now;                      ///< of the state
};

/// The message of that id as the vehicle sends it; nullopt: it sends no such message, or cannot
/// now, because it knows no place or home.
std::optional<Message> telemetry_message(std::uint32_t id, const TelemetrySource& source);

}  // namespace trident::bridges::mavlink
