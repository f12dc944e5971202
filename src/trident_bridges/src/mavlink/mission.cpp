// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/mission.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "trident_bridges/mavlink/dialect.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kDegrees = 1e7;  // of x and y in one degree

bool are_same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

const char* text_of(MissionType type) {
  constexpr std::array<const char*, kMissionTypes> kTexts{"mission", "fence", "rally points"};
  return kTexts[static_cast<std::size_t>(type)];
}

const char* text_of(MissionResult result) {
  constexpr std::array<const char*, 16> kTexts{"accepted",
                                               "error",
                                               "unsupported frame",
                                               "unsupported command",
                                               "no space",
                                               "invalid",
                                               "invalid param1",
                                               "invalid param2",
                                               "invalid param3",
                                               "invalid param4",
                                               "invalid param5",
                                               "invalid param6",
                                               "invalid param7",
                                               "invalid sequence",
                                               "denied",
                                               "cancelled"};
  const auto index = static_cast<std::size_t>(result);
  return index < kTexts.size() ? kTexts[index] : "unknown result";
}

bool operator==(const MissionItem& a, const MissionItem& b) {
  return a.command == b.command && a.frame == b.frame && a.is_current == b.is_current &&
         a.autocontinue == b.autocontinue && a.x == b.x && a.y == b.y &&
         std::equal(a.params.begin(), a.params.end(), b.params.begin(), are_same) &&
         are_same(a.z, b.z);
}

bool is_global_frame(std::uint8_t frame) {
  switch (frame) {
    case MAV_FRAME_GLOBAL:
    case MAV_FRAME_GLOBAL_RELATIVE_ALT:
    case MAV_FRAME_GLOBAL_INT:
    case MAV_FRAME_GLOBAL_RELATIVE_ALT_INT:
    case MAV_FRAME_GLOBAL_TERRAIN_ALT:
    case MAV_FRAME_GLOBAL_TERRAIN_ALT_INT:
      return true;
    default:
      return false;
  }
}

bool has_place(std::uint16_t command) {
  switch (command) {
    case MAV_CMD_NAV_WAYPOINT:
    case MAV_CMD_NAV_LOITER_UNLIM:
    case MAV_CMD_NAV_LOITER_TURNS:
    case MAV_CMD_NAV_LOITER_TIME:
    case MAV_CMD_NAV_LAND:
    case MAV_CMD_NAV_TAKEOFF:
    case MAV_CMD_NAV_LOITER_TO_ALT:
    case MAV_CMD_NAV_SPLINE_WAYPOINT:
    case MAV_CMD_DO_SET_HOME:
    case MAV_CMD_DO_REPOSITION:
    case MAV_CMD_DO_SET_ROI_LOCATION:
    case MAV_CMD_DO_SET_ROI:
    case MAV_CMD_NAV_FENCE_RETURN_POINT:
    case MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION:
    case MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION:
    case MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION:
    case MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION:
    case MAV_CMD_NAV_RALLY_POINT:
      return true;
    default:
      return false;
  }
}

double scale_of_place(std::uint16_t command, std::uint8_t frame) {
  constexpr double kPerDegree = 1e7, kPerMeter = 1e4;
  if (!has_place(command)) return 1.0;
  return is_global_frame(frame) ? kPerDegree : kPerMeter;
}

MissionVerdict check_place(const MissionItem& item) {
  if (!has_place(item.command)) return {};
  const auto text = [](double degrees, const char* what, const char* limit) {
    return std::string(what) + " " + std::to_string(degrees) + " deg, legal: +-" + limit;
  };
  if (!std::isfinite(item.z)) {
    return {MissionResult::kInvalidParam7, "altitude is not a finite number"};
  }
  if (!is_global_frame(item.frame)) return {};
  if (std::abs(item.x / kDegrees) > 90.0) {
    return {MissionResult::kInvalidParam5, text(item.x / kDegrees, "latitude", "90")};
  }
  if (std::abs(item.y / kDegrees) > 180.0) {
    return {MissionResult::kInvalidParam6, text(item.y / kDegrees, "longitude", "180")};
  }
  return {};
}

}  // namespace trident::bridges::mavlink
