// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mavros_msgs/Waypoint.h>

#include <string>

#include "trident_bridges/mavlink/mission.h"

namespace trident::mavros {

/// What is wrong with the place of a waypoint that has one; "" where it is on earth, or within
/// 200 km of a local frame's origin.
std::string problem_of(const mavros_msgs::Waypoint& waypoint);
/// An item of a list as MAVLink has it. Where the frame is MISSION, x_lat and y_long are param5 and
/// param6 as they are.
bridges::mavlink::MissionItem to_item(const mavros_msgs::Waypoint& waypoint);
/// The reverse.
mavros_msgs::Waypoint to_waypoint(const bridges::mavlink::MissionItem& item);

}  // namespace trident::mavros
