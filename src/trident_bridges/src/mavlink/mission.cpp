// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/mission.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

#include "trident_base/is_one_of.h"
#include "trident_bridges/mavlink/dialect.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kDegrees = 1e7;  // of x and y in one degree

constexpr std::uint8_t kGlobalFrames[] = {MAV_FRAME_GLOBAL,
                                          MAV_FRAME_GLOBAL_RELATIVE_ALT,
                                          MAV_FRAME_GLOBAL_INT,
                                          MAV_FRAME_GLOBAL_RELATIVE_ALT_INT,
                                          MAV_FRAME_GLOBAL_TERRAIN_ALT,
                                          MAV_FRAME_GLOBAL_TERRAIN_ALT_INT};

constexpr std::uint16_t kCommandsWithPlace[] = {MAV_CMD_NAV_WAYPOINT,
                                                MAV_CMD_NAV_LOITER_UNLIM,
                                                MAV_CMD_NAV_LOITER_TURNS,
                                                MAV_CMD_NAV_LOITER_TIME,
                                                MAV_CMD_NAV_LAND,
                                                MAV_CMD_NAV_TAKEOFF,
                                                MAV_CMD_NAV_LOITER_TO_ALT,
                                                MAV_CMD_NAV_SPLINE_WAYPOINT,
                                                MAV_CMD_DO_SET_HOME,
                                                MAV_CMD_DO_REPOSITION,
                                                MAV_CMD_DO_SET_ROI_LOCATION,
                                                MAV_CMD_DO_SET_ROI,
                                                MAV_CMD_NAV_FENCE_RETURN_POINT,
                                                MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION,
                                                MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION,
                                                MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION,
                                                MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION,
                                                MAV_CMD_NAV_RALLY_POINT};

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
  return std::tie(a.command, a.frame, a.is_current, a.autocontinue, a.x, a.y) ==
             std::tie(b.command, b.frame, b.is_current, b.autocontinue, b.x, b.y) &&
         std::equal(a.params.begin(), a.params.end(), b.params.begin(), are_same) &&
         are_same(a.z, b.z);
}

bool is_global_frame(std::uint8_t frame) { return is_one_of(frame, kGlobalFrames); }

bool has_place(std::uint16_t command) { return is_one_of(command, kCommandsWithPlace); }

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
