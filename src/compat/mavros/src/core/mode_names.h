// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace trident::mavros {

/// Name of a vehicle's mode as State.mode has it; CMODE(number) where it has no name. `autopilot`:
/// MAV_AUTOPILOT, `type`: MAV_TYPE.
std::string mode_name(std::uint8_t autopilot, std::uint8_t type, std::uint32_t custom_mode);

/// The mode of a name, or of a number in digits; nullopt: this vehicle has no such mode.
std::optional<std::uint32_t> mode_number(std::uint8_t autopilot, std::uint8_t type,
                                         const std::string& name);

/// All names that a vehicle has, with commas between them.
std::string mode_names_text(std::uint8_t autopilot, std::uint8_t type);

}  // namespace trident::mavros
