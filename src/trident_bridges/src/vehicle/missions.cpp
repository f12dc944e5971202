// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/vehicle/missions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "trident_base/string_util.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/whole_number.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kUnits_per_degree = 1e7;
constexpr double kUnits_per_meter = 1e4;

Eigen::Vector3d numbers_of(const MissionItem& item) {
  const double scale = is_global_frame(item.frame) ? kUnits_per_degree : kUnits_per_meter;
  return {item.x / scale, item.y / scale, item.z};
}

/// Latitude and longitude 0 stand for "where it is".
bool has_horizontal_place(const MissionItem& item) {
  return !is_global_frame(item.frame) || item.x != 0 || item.y != 0;
}

/// The one command for places to look at that autopilots here know.
std::uint16_t command_of(const MissionItem& item) {
  const bool is_roi = item.command == MAV_CMD_DO_SET_ROI_LOCATION ||
                      item.command == MAV_CMD_DO_SET_ROI_NONE ||
                      item.command == MAV_CMD_DO_SET_ROI_WPNEXT_OFFSET;
  return is_roi ? mission_command::kRegionOfInterest : item.command;
}

bridges::MissionItem convert(const MissionItem& item, const PlaceContext& context) {
  bridges::MissionItem converted;
  converted.command = command_of(item);
  std::copy(item.params.begin(), item.params.end(), converted.params.begin());
  converted.has_place = false;
  if (!has_place(item.command)) return converted;
  const auto place = place_in_world(item.frame, numbers_of(item), context);
  if (!place) return converted;
  converted.p_world_m = *place;
  converted.has_place = has_horizontal_place(item);
  if (!converted.has_place) {
    // Only the height counts, such as that of a take-off.
    const GeoPlace home = context.geo.to_geo(context.home_m);
    const Eigen::Vector3d above_home(home.latitude_deg, home.longitude_deg, item.z);
    converted.p_world_m = *place_in_world(item.frame, above_home, context);
    converted.has_place = item.command == MAV_CMD_NAV_TAKEOFF;
  }
  return converted;
}

bool is_corner(std::uint16_t command) {
  return command == MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION ||
         command == MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION;
}

bool is_circle(std::uint16_t command) {
  return command == MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION ||
         command == MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION;
}

/// How clients that must send a circle, as MAVSDK's old ones, say that they have none.
bool is_no_circle(const MissionItem& item) {
  return is_circle(item.command) && item.params[0] == 0.0F;
}

/// A breach holds, returns home or lands: there is no other place to return to.
bool has_no_region(const MissionItem& item) {
  return is_no_circle(item) || item.command == MAV_CMD_NAV_FENCE_RETURN_POINT;
}

Eigen::Vector2d flat_place(const MissionItem& item, const PlaceContext& context) {
  const auto place = place_in_world(item.frame, numbers_of(item), context);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return place ? Eigen::Vector2d(place->head<2>()) : Eigen::Vector2d(nan, nan);
}

MissionVerdict refuse_item(std::size_t index, MissionResult result, const std::string& reason) {
  return {result, "fence item " + std::to_string(index) + ": " + reason};
}

/// The polygon that begins at `first`, with param1 corners in a row.
MissionVerdict read_polygon(const Mission& list, std::size_t first, const PlaceContext& context,
                            Fence::Region& region) {
  const MissionItem& head = list[first];
  const double count = head.params[0];
  if (!(count >= 3.0 && count <= static_cast<double>(list.size() - first))) {
    return refuse_item(first, MissionResult::kInvalidParam1,
                       "polygon of " + number_text(count) + " corners, legal: 3 to " +
                           std::to_string(list.size() - first) + " that follow");
  }
  region.is_inclusion = head.command == MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION;
  for (std::size_t i = first; i < first + static_cast<std::size_t>(count); ++i) {
    if (list[i].command != head.command || list[i].params[0] != head.params[0]) {
      return refuse_item(i, MissionResult::kInvalid,
                         "not a corner of the polygon of item " + std::to_string(first));
    }
    region.corners_m.push_back(flat_place(list[i], context));
  }
  return {};
}

}  // namespace

std::vector<bridges::MissionItem> to_autopilot(const Mission& mission, Flavor flavor,
                                               const PlaceContext& context) {
  const bool begins_with_home = flavor == Flavor::kArduPilot;
  if (begins_with_home && mission.size() == 1) return {};
  std::vector<bridges::MissionItem> items;
  for (const MissionItem& item : mission) items.push_back(convert(item, context));
  if (begins_with_home && !items.empty()) {
    items.front() = {};
    items.front().command = mission_command::kSetServo;
    items.front().has_place = false;
  }
  return items;
}

MissionItem home_item(const GeoPlace& home) {
  MissionItem item;
  item.command = MAV_CMD_NAV_WAYPOINT;
  item.frame = MAV_FRAME_GLOBAL;
  item.x = degrees_e7(home.latitude_deg);
  item.y = degrees_e7(home.longitude_deg);
  item.z = static_cast<float>(home.altitude_m);
  return item;
}

MissionVerdict read_fence(const Mission& list, const PlaceContext& context,
                          std::vector<Fence::Region>& regions) {
  for (std::size_t i = 0; i < list.size();) {
    if (has_no_region(list[i])) {
      ++i;
      continue;
    }
    Fence::Region region;
    if (is_corner(list[i].command)) {
      MissionVerdict verdict = read_polygon(list, i, context, region);
      if (!verdict.is_accepted()) return verdict;
      i += region.corners_m.size();
    } else if (is_circle(list[i].command)) {
      region.is_inclusion = list[i].command == MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION;
      region.center_m = flat_place(list[i], context);
      region.radius_m = list[i].params[0];
      ++i;
    } else {
      return refuse_item(i, MissionResult::kUnsupported,
                         "command " + std::to_string(list[i].command) + ", legal: 5000 to 5004");
    }
    regions.push_back(std::move(region));
  }
  return {};
}

std::string notice_of_fence(const Mission& list) {
  const auto count = std::count_if(list.begin(), list.end(), is_no_circle);
  if (count == 0) return {};
  const auto first = std::find_if(list.begin(), list.end(), is_no_circle) - list.begin();
  return "fence: circles of radius 0 do not count: " + std::to_string(count) + ", from item " +
         std::to_string(first);
}

MissionVerdict to_verdict(const Answer& answer) {
  if (answer.is_good()) return {};
  if (answer.result == Result::kUnsupported) return {MissionResult::kUnsupported, answer.text};
  if (answer.result == Result::kDenied) return {MissionResult::kInvalid, answer.text};
  return {MissionResult::kDenied, answer.text};
}

}  // namespace trident::bridges::mavlink
