// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What a vehicle says of itself, but for its motion.
#pragma once

#include <optional>

#include "trident_bridges/vehicle/telemetry.h"

namespace trident::bridges::mavlink {

/// See telemetry_message(): HEARTBEAT, SYS_STATUS, EXTENDED_SYS_STATE, BATTERY_STATUS, SYSTEM_TIME,
/// MISSION_CURRENT, HOME_POSITION and GPS_GLOBAL_ORIGIN.
std::optional<Message> status_message(std::uint32_t id, const TelemetrySource& source);

}  // namespace trident::bridges::mavlink
