// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_bridges/autopilot/answer.h"
#include "trident_bridges/autopilot/fence.h"
#include "trident_bridges/autopilot/mission.h"
#include "trident_bridges/autopilot/vehicle.h"
#include "trident_bridges/mavlink/mission.h"
#include "trident_bridges/vehicle/geo_frame.h"

namespace trident::bridges::mavlink {

/// A mission as the autopilot flies it. Indices stay: item 0 of ArduPilot's lists, which is home,
/// becomes one that does nothing; a list of it alone becomes empty. Heights above home count from
/// context.home_m.
std::vector<bridges::MissionItem> to_autopilot(const Mission& mission, Flavor flavor,
                                               const PlaceContext& context);
/// ArduPilot's item 0.
MissionItem home_item(const GeoPlace& home);

/// Reads a list of type kFence into `regions`; refused: a polygon without all its corners, or a
/// command that belongs to no fence. A circle of radius 0 does not count.
MissionVerdict read_fence(const Mission& list, const PlaceContext& context,
                          std::vector<Fence::Region>& regions);
/// Which of a fence's items do not count, in words; empty: all do.
std::string notice_of_fence(const Mission& list);

/// An autopilot's answer as one about a mission.
MissionVerdict to_verdict(const Answer& answer);

}  // namespace trident::bridges::mavlink
