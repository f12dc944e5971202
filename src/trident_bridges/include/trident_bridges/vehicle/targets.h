// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "trident_base/sim_time.h"
#include "trident_bridges/autopilot/setpoint_stream.h"
#include "trident_bridges/mavlink/message.h"
#include "trident_bridges/vehicle/geo_frame.h"

namespace trident::bridges::mavlink {

/// What a set-point message asks for.
struct ReceivedTarget {
  Target target;                 ///< world
  std::optional<SimTime> stamp;  ///< by its sender's clock; none: it gives 0
  std::string problem;           ///< why it cannot be followed; empty: it can
};

/// Reads SET_POSITION_TARGET_LOCAL_NED (frames 1, 7, 8, 9, 12), SET_POSITION_TARGET_GLOBAL_INT (0,
/// 3, 5, 6, 10, 11) and SET_ATTITUDE_TARGET. Of position, velocity and acceleration each is given
/// with all its axes or not at all; so are body rates, but for a rate about the vertical alone.
/// nullopt: another message, or for another vehicle than `self`.
std::optional<ReceivedTarget> read_target(const Message& message, Address self,
                                          const PlaceContext& context);

}  // namespace trident::bridges::mavlink
