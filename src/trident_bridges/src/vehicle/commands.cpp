// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/vehicle/commands.h"

#include <cmath>
#include <map>
#include <string>

#include "trident_base/angle.h"
#include "trident_base/is_one_of.h"
#include "trident_base/string_util.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/frames.h"
#include "trident_bridges/mavlink/mission.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kForced = 21196.0;    // param2 of MAV_CMD_COMPONENT_ARM_DISARM
constexpr double kRoiLocation = 3.0;   // MAV_ROI_LOCATION
constexpr double kCustomMode = 1.0;    // MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
constexpr double kGreatestMode = 255;  // of PX4's main and sub mode

/// Commands that change nothing but what is sent.
constexpr std::uint16_t kQuestions[] = {MAV_CMD_GET_MESSAGE_INTERVAL,
                                        MAV_CMD_SET_MESSAGE_INTERVAL,
                                        MAV_CMD_REQUEST_MESSAGE,
                                        MAV_CMD_REQUEST_PROTOCOL_VERSION,
                                        MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES,
                                        MAV_CMD_GET_HOME_POSITION,
                                        MAV_CMD_RUN_PREARM_CHECKS};

/// Messages that change something, apart from commands.
constexpr std::uint32_t kOrders[] = {MAVLINK_MSG_ID_SET_MODE,
                                     MAVLINK_MSG_ID_PARAM_SET,
                                     MAVLINK_MSG_ID_MISSION_ITEM,
                                     MAVLINK_MSG_ID_MISSION_ITEM_INT,
                                     MAVLINK_MSG_ID_MISSION_CLEAR_ALL,
                                     MAVLINK_MSG_ID_MISSION_SET_CURRENT,
                                     MAVLINK_MSG_ID_MANUAL_CONTROL,
                                     MAVLINK_MSG_ID_RC_CHANNELS_OVERRIDE,
                                     MAVLINK_MSG_ID_SET_ATTITUDE_TARGET,
                                     MAVLINK_MSG_ID_SET_POSITION_TARGET_LOCAL_NED,
                                     MAVLINK_MSG_ID_SET_POSITION_TARGET_GLOBAL_INT,
                                     MAVLINK_MSG_ID_SET_HOME_POSITION,
                                     MAVLINK_MSG_ID_SET_GPS_GLOBAL_ORIGIN};

struct Asked {
  const Command& command;
  Flavor flavor;
  const PlaceContext& context;
  double param(std::size_t number) const { return command.params[number - 1]; }  // from 1
};

CommandReply refuse(const Asked& asked, std::size_t number, const char* legal) {
  return {CommandResult::kDenied,
          "command " + std::to_string(asked.command.command) + ": param" + std::to_string(number) +
              " " + number_text(asked.param(number)) + ", legal: " + legal,
          0};
}

/// Of param 5 to 7; COMMAND_LONG names none.
std::uint8_t frame_of(const Asked& asked) {
  if (asked.command.is_int) return asked.command.frame;
  return asked.flavor == Flavor::kPx4 ? MAV_FRAME_GLOBAL : MAV_FRAME_GLOBAL_RELATIVE_ALT;
}

/// Param 5 to 7 in the world; nullopt where the frame has no places or a number is missing.
std::optional<Eigen::Vector3d> place_of(const Asked& asked) {
  const Eigen::Vector3d numbers(asked.param(5), asked.param(6), asked.param(7));
  if (!numbers.allFinite()) return std::nullopt;
  const std::uint8_t frame = frame_of(asked);
  if (is_global_frame(frame) &&
      !(std::abs(numbers.x()) <= 90.0 && std::abs(numbers.y()) <= 180.0)) {
    return std::nullopt;
  }
  return place_in_world(frame, numbers, asked.context);
}

Interpretation arm(const Asked& asked) {
  if (asked.param(1) != 0.0 && asked.param(1) != 1.0) return refuse(asked, 1, "0 or 1");
  return ArmRequest{asked.param(1) == 1.0, asked.param(2) == kForced};
}

bool is_custom_mode(double base) {
  return base >= 0.0 && base < 256.0 && std::fmod(base, 2.0) == kCustomMode;
}

bool is_mode_number(double value) { return value >= 0.0 && value <= kGreatestMode; }

Interpretation set_mode(const Asked& asked) {
  const double main = asked.param(2);
  if (!is_custom_mode(asked.param(1)))
    return refuse(asked, 1, "an odd number: the mode is that of param2");
  if (!is_mode_number(main)) return refuse(asked, 2, "0 to 255");
  if (asked.flavor == Flavor::kArduPilot) return ModeRequest{static_cast<std::uint32_t>(main)};
  const double sub = std::isnan(asked.param(3)) ? 0.0 : asked.param(3);
  if (!is_mode_number(sub)) return refuse(asked, 3, "0 to 255");
  return ModeRequest{static_cast<std::uint32_t>(main) << 16 | static_cast<std::uint32_t>(sub)
                                                                  << 24};
}

Interpretation take_off(const Asked& asked) {
  const double altitude = asked.param(7);
  if (std::isnan(altitude)) return TakeOffRequest{};
  const bool is_above_sea = asked.command.is_int ? asked.command.frame == MAV_FRAME_GLOBAL ||
                                                       asked.command.frame == MAV_FRAME_GLOBAL_INT
                                                 : asked.flavor == Flavor::kPx4;
  const PlaceContext& context = asked.context;
  const double base = is_above_sea ? context.geo.to_geo(context.p_m).altitude_m
                                   : context.p_m.z() - context.home_m.z();
  return TakeOffRequest{altitude - base};
}

Interpretation change_speed(const Asked& asked) {
  if (asked.param(2) == -1.0) return CommandReply{};  // as it is
  return SpeedRequest{asked.param(2)};
}

Interpretation turn(const Asked& asked) {
  const bool is_relative = asked.param(4) == 1.0;
  const double angle = deg_to_rad(asked.param(1));
  if (!std::isfinite(angle)) return refuse(asked, 1, "a finite angle");
  if (is_relative) return YawRequest{asked.param(3) < 0.0 ? angle : -angle, true};
  return YawRequest{swap_yaw(angle), false};
}

Interpretation set_home(const Asked& asked) {
  if (asked.param(1) == 1.0) return HomeRequest{};
  if (const auto place = place_of(asked)) return HomeRequest{*place};
  return refuse(asked, 5, "a place with its altitude, in degrees of WGS84");
}

Interpretation reposition(const Asked& asked) {
  const bool is_here = std::isnan(asked.param(5)) && std::isnan(asked.param(6));
  const auto place = is_here ? std::optional(asked.context.p_m) : place_of(asked);
  if (!place) return refuse(asked, 5, "a place with its altitude, in degrees of WGS84");
  GoToRequest request;
  request.p_world_m = *place;
  request.speed_m_s = asked.param(1) > 0.0 ? asked.param(1) : 0.0;
  if (std::isfinite(asked.param(4))) request.yaw = swap_yaw(asked.param(4));  // in radians
  return request;
}

Interpretation look_at(const Asked& asked) {
  const bool is_old = asked.command.command == MAV_CMD_DO_SET_ROI;
  if (is_old && asked.param(1) != kRoiLocation) return LookAtRequest{};
  if (const auto place = place_of(asked)) return LookAtRequest{*place};
  return refuse(asked, 5, "a place with its altitude, in degrees of WGS84");
}

Interpretation pause(const Asked& asked) {
  if (asked.param(1) != 0.0 && asked.param(1) != 1.0) return refuse(asked, 1, "0 or 1");
  return PauseRequest{asked.param(1) == 0.0};
}

Interpretation enable_fence(const Asked& asked) {
  if (asked.param(1) != 0.0 && asked.param(1) != 1.0) return refuse(asked, 1, "0 or 1");
  return FenceRequest{asked.param(1) == 1.0};
}

bool is_index(double value) {
  return value >= 0.0 && value < 65536.0 && value == std::floor(value);
}

Interpretation choose_item(const Asked& asked) {
  if (!is_index(asked.param(1))) return refuse(asked, 1, "an index of an item, from 0");
  return MissionItemRequest{static_cast<int>(asked.param(1))};
}

Interpretation start_mission(const Asked& asked) {
  if (std::isnan(asked.param(1))) return MissionStartRequest{};
  if (!is_index(asked.param(1))) return refuse(asked, 1, "an index of an item, from 0");
  return MissionStartRequest{static_cast<int>(asked.param(1))};
}

Interpretation unsupported(const std::string& reason) {
  return CommandReply{CommandResult::kUnsupported, reason, 0};
}

using Reader = Interpretation (*)(const Asked&);

/// Those that are executed at once; all others belong to missions, or are not known.
const std::map<std::uint16_t, Reader>& readers() {
  static const std::map<std::uint16_t, Reader> kReaders{
      {MAV_CMD_NAV_LOITER_UNLIM, [](const Asked&) -> Interpretation { return PauseRequest{true}; }},
      {MAV_CMD_NAV_RETURN_TO_LAUNCH,
       [](const Asked&) -> Interpretation { return ReturnRequest{}; }},
      {MAV_CMD_NAV_LAND, [](const Asked&) -> Interpretation { return LandRequest{}; }},
      {MAV_CMD_NAV_TAKEOFF, take_off},
      {MAV_CMD_CONDITION_YAW, turn},
      {MAV_CMD_DO_SET_MODE, set_mode},
      {MAV_CMD_DO_CHANGE_SPEED, change_speed},
      {MAV_CMD_DO_SET_HOME, set_home},
      {MAV_CMD_DO_SET_SERVO, [](const Asked&) -> Interpretation { return CommandReply{}; }},
      {MAV_CMD_DO_REPOSITION, reposition},
      {MAV_CMD_DO_PAUSE_CONTINUE, pause},
      {MAV_CMD_DO_SET_ROI_LOCATION, look_at},
      {MAV_CMD_DO_SET_ROI_WPNEXT_OFFSET,
       [](const Asked&) -> Interpretation { return LookAtRequest{}; }},
      {MAV_CMD_DO_SET_ROI_NONE, [](const Asked&) -> Interpretation { return LookAtRequest{}; }},
      {MAV_CMD_DO_SET_ROI, look_at},
      {MAV_CMD_DO_FENCE_ENABLE, enable_fence},
      {MAV_CMD_DO_SET_MISSION_CURRENT, choose_item},
      {MAV_CMD_MISSION_START, start_mission},
      {MAV_CMD_COMPONENT_ARM_DISARM, arm},
      {MAV_CMD_RUN_PREARM_CHECKS, [](const Asked&) -> Interpretation { return CheckRequest{}; }},
  };
  return kReaders;
}

}  // namespace

Interpretation interpret(const Command& command, Flavor flavor, const PlaceContext& context) {
  const auto reader = readers().find(command.command);
  if (reader == readers().end()) {
    return unsupported("command " + std::to_string(command.command) +
                       " is not known, or is for missions alone");
  }
  return reader->second(Asked{command, flavor, context});
}

bool changes_behavior(const Message& message) {
  switch (message.id) {
    case MAVLINK_MSG_ID_COMMAND_LONG:
      return !is_one_of(unpack<mavlink_command_long_t>(message).command, kQuestions);
    case MAVLINK_MSG_ID_COMMAND_INT:
      return !is_one_of(unpack<mavlink_command_int_t>(message).command, kQuestions);
    default:
      return is_one_of(message.id, kOrders);
  }
}

}  // namespace trident::bridges::mavlink
