// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "trident_bridges/vehicle/telemetry.h"

namespace trident::bridges::mavlink {

/// What the autopilot asks of its controllers; nullopt: another message, or it asks otherwise.
std::optional<Message> setpoint_message(std::uint32_t id, const TelemetrySource& source);

}  // namespace trident::bridges::mavlink
