// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "trident_bridges/mavlink/message.h"

namespace trident::bridges::mavlink {

/// MAV_MISSION_TYPE: a vehicle has one list of each.
enum class MissionType : std::uint8_t { kMission = 0, kFence = 1, kRally = 2 };
inline constexpr std::size_t kMissionTypes = 3;         ///< how many there are
inline constexpr std::uint8_t kAllMissionTypes = 255;   ///< in MISSION_CLEAR_ALL
inline constexpr std::size_t kMaxMissionItems = 2'000;  ///< that a vehicle holds of each type

/// "mission", "fence", "rally points".
const char* text_of(MissionType type);

/// MAV_MISSION_RESULT.
enum class MissionResult : std::uint8_t {
  kAccepted = 0,
  kError = 1,
  kUnsupportedFrame = 2,
  kUnsupported = 3,
  kNoSpace = 4,
  kInvalid = 5,
  kInvalidParam1 = 6,
  kInvalidParam2 = 7,
  kInvalidParam3 = 8,
  kInvalidParam4 = 9,
  kInvalidParam5 = 10,
  kInvalidParam6 = 11,
  kInvalidParam7 = 12,
  kInvalidSequence = 13,
  kDenied = 14,
  kCancelled = 15
};

/// "accepted", "no space" ...
const char* text_of(MissionResult result);

/// Whether something was accepted, and if not, the rule, value and limit.
struct MissionVerdict {
  MissionResult result = MissionResult::kAccepted;  ///< for MISSION_ACK
  std::string reason;                               ///< for people; empty where accepted
  bool is_accepted() const { return result == MissionResult::kAccepted; }  ///< of the result
};

/// One item of a mission, a fence or a list of rally points.
struct MissionItem {
  std::uint16_t command = 0;      ///< MAV_CMD
  std::uint8_t frame = 0;         ///< MAV_FRAME
  bool is_current = false;        ///< where the mission begins
  bool autocontinue = true;       ///< to the next item by itself
  std::array<float, 4> params{};  ///< param1 to param4; NaN: not given
  std::int32_t x = 0;             ///< latitude [1e-7 deg], or north or param5 [1e-4 m, 1e-4]
  std::int32_t y = 0;             ///< longitude [1e-7 deg], or east or param6 [1e-4 m, 1e-4]
  float z = 0.0F;                 ///< altitude by the frame, or down [m], or param7

  /// NaN, which stands for what is not given, equals itself.
  friend bool operator==(const MissionItem& a, const MissionItem& b);
  friend bool operator!=(const MissionItem& a, const MissionItem& b) { return !(a == b); }
};

/// A whole list, in its order.
using Mission = std::vector<MissionItem>;

/// Whether the frame's x and y are degrees.
bool is_global_frame(std::uint8_t frame);
/// Whether the command's x, y and z are a place.
bool has_place(std::uint16_t command);
/// By how much x and y of COMMAND_INT are multiplied on the wire: a degree, a meter, or one where
/// they are no place.
double scale_of_place(std::uint16_t command, std::uint8_t frame);
/// Refuses an item with a place that is no number or not on the earth.
MissionVerdict check_place(const MissionItem& item);

}  // namespace trident::bridges::mavlink
