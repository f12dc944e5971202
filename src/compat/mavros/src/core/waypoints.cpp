// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/waypoints.h"

#include <cmath>
#include <cstdint>

#include "core/conversions.h"
#include "trident_base/string_util.h"

namespace trident::mavros {
namespace {

constexpr double kItemsPerDegree = 1e7, kItemsPerMeter = 1e4;

double units_of_frame(std::uint8_t frame) {
  if (frame == mavros_msgs::Waypoint::FRAME_MISSION) return 1.0;
  return bridges::mavlink::is_global_frame(frame) ? kItemsPerDegree : kItemsPerMeter;
}

}  // namespace

std::string problem_of(const mavros_msgs::Waypoint& waypoint) {
  if (!bridges::mavlink::has_place(waypoint.command)) return "";
  constexpr double kMaxLatitude = 90.0, kMaxLongitude = 180.0, kMaxMeters = 2e5;
  const bool is_global = bridges::mavlink::is_global_frame(waypoint.frame);
  const double max_x = is_global ? kMaxLatitude : kMaxMeters;
  const double max_y = is_global ? kMaxLongitude : kMaxMeters;
  const auto text = [](const char* what, double value, double limit) {
    return std::string(what) + " is " + number_text(value) + ", legal: +-" + number_text(limit);
  };
  if (!(std::abs(waypoint.x_lat) <= max_x)) return text("x_lat", waypoint.x_lat, max_x);
  if (!(std::abs(waypoint.y_long) <= max_y)) return text("y_long", waypoint.y_long, max_y);
  return "";
}

bridges::mavlink::MissionItem to_item(const mavros_msgs::Waypoint& waypoint) {
  bridges::mavlink::MissionItem item;
  const double units = units_of_frame(waypoint.frame);
  item.command = waypoint.command;
  item.frame = waypoint.frame;
  item.is_current = waypoint.is_current != 0U;
  item.autocontinue = waypoint.autocontinue != 0U;
  item.params = {waypoint.param1, waypoint.param2, waypoint.param3, waypoint.param4};
  item.x = to_whole<std::int32_t>(waypoint.x_lat * units);
  item.y = to_whole<std::int32_t>(waypoint.y_long * units);
  item.z = static_cast<float>(waypoint.z_alt);
  return item;
}

mavros_msgs::Waypoint to_waypoint(const bridges::mavlink::MissionItem& item) {
  mavros_msgs::Waypoint waypoint;
  const double units = units_of_frame(item.frame);
  waypoint.command = item.command;
  waypoint.frame = item.frame;
  waypoint.is_current = item.is_current;
  waypoint.autocontinue = item.autocontinue;
  waypoint.param1 = item.params[0];
  waypoint.param2 = item.params[1];
  waypoint.param3 = item.params[2];
  waypoint.param4 = item.params[3];
  waypoint.x_lat = item.x / units;
  waypoint.y_long = item.y / units;
  waypoint.z_alt = item.z;
  return waypoint;
}

}  // namespace trident::mavros
