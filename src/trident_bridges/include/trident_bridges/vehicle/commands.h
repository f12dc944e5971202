// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "trident_bridges/autopilot/requests.h"
#include "trident_bridges/autopilot/vehicle.h"
#include "trident_bridges/mavlink/command.h"
#include "trident_bridges/mavlink/message.h"
#include "trident_bridges/vehicle/geo_frame.h"

namespace trident::bridges::mavlink {

/// What a command asks of the autopilot, or the reply where it is not to be asked: refusals name
/// the parameter, its value and what is legal.
using Interpretation = std::variant<Request, CommandReply>;

/// Reads a command of a ground station. Places of a COMMAND_LONG have their altitude above sea
/// level for PX4 and above home for ArduPilot, as these do.
Interpretation interpret(const Command& command, Flavor flavor, const PlaceContext& context);

/// Whether what somebody sends may change what a vehicle does: commands, missions, parameters,
/// set-points, sticks. False: it asks, or says that it is there.
bool changes_behavior(const Message& message);

}  // namespace trident::bridges::mavlink
