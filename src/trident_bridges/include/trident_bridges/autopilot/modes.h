// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trident_bridges/autopilot/vehicle.h"

namespace trident::bridges {

/// What a vehicle does by itself and what it leaves to others. One name for what PX4 and ArduPilot
/// call differently.
enum class Mode {
  kManual,     ///< sticks: speed and turn of a ground robot or vessel
  kStabilize,  ///< sticks: roll, pitch, thrust
  kAcro,       ///< sticks: body rates, thrust
  kAltitude,   ///< sticks: roll and pitch; the height is kept
  kPosition,   ///< sticks: velocity; without them the place is kept
  kHold,       ///< stays where it is
  kMission,    ///< flies the mission
  kReturn,     ///< back to the home position
  kLand,       ///< down where it is
  kTakeOff,    ///< up where it is
  kOffboard,   ///< follows set-points, which must keep coming (PX4)
  kGuided,     ///< follows set-points and single places (ArduPilot)
  kBrake,      ///< stops as hard as it may
};

/// One mode as a ground station knows it.
struct ModeEntry {
  Mode mode;                  ///< ours
  std::uint32_t custom_mode;  ///< HEARTBEAT.custom_mode
  const char* name;           ///< as mavros and MAVProxy print it
};

/// The modes of a kind of vehicle in one flavor, the first is that after start.
/// PX4: main mode << 16 | sub mode << 24.
const std::vector<ModeEntry>& modes_of(Flavor flavor, VehicleClass vehicle);

/// By number; nullptr: this vehicle has no such mode.
const ModeEntry* find_mode(Flavor flavor, VehicleClass vehicle, std::uint32_t custom_mode);
/// By name; nullptr: this vehicle has no such mode.
const ModeEntry* find_mode(Flavor flavor, VehicleClass vehicle, std::string_view name);
/// Of a mode; nullptr: this vehicle has no such mode.
const ModeEntry* find_mode(Flavor flavor, VehicleClass vehicle, Mode mode);

/// Names of all modes of a vehicle, for messages.
std::vector<std::string> mode_names(Flavor flavor, VehicleClass vehicle);

/// Whether the pilot's sticks move the vehicle in this mode.
bool is_manual(Mode mode);
/// Whether a companion computer's set-points move the vehicle in this mode.
bool follows_targets(Mode mode);
/// Whether a vehicle cannot be armed in this mode.
bool prevents_arming(Mode mode);
/// Whether the mode can be entered or kept only with a known place.
bool needs_position(Mode mode);

}  // namespace trident::bridges
