// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mode_names.h"

#include <algorithm>
#include <vector>

#include "trident_bridges/mavlink/dialect.h"

namespace trident::mavros {
namespace {

struct NamedMode {
  std::uint32_t number;
  const char* name;
};
using NamedModes = std::vector<NamedMode>;

/// PX4's custom mode: main mode, and sub mode of AUTO (px4_custom_mode.h).
constexpr std::uint32_t px4_mode(std::uint32_t main, std::uint32_t sub = 0) {
  return main << 16 | sub << 24;
}

const NamedModes kPx4Modes = {
    {px4_mode(1), "MANUAL"},
    {px4_mode(2), "ALTCTL"},
    {px4_mode(3), "POSCTL"},
    {px4_mode(4, 1), "AUTO.READY"},
    {px4_mode(4, 2), "AUTO.TAKEOFF"},
    {px4_mode(4, 3), "AUTO.LOITER"},
    {px4_mode(4, 4), "AUTO.MISSION"},
    {px4_mode(4, 5), "AUTO.RTL"},
    {px4_mode(4, 6), "AUTO.LAND"},
    {px4_mode(4, 7), "AUTO.RTGS"},
    {px4_mode(4, 8), "AUTO.FOLLOW_TARGET"},
    {px4_mode(4, 9), "AUTO.PRECLAND"},
    {px4_mode(5), "ACRO"},
    {px4_mode(6), "OFFBOARD"},
    {px4_mode(7), "STABILIZED"},
    {px4_mode(8), "RATTITUDE"},
};
// mode.h of ArduCopter, ArduPlane, Rover and ArduSub.
const NamedModes kCopterModes = {
    {0, "STABILIZE"},   {1, "ACRO"},      {2, "ALT_HOLD"}, {3, "AUTO"},        {4, "GUIDED"},
    {5, "LOITER"},      {6, "RTL"},       {7, "CIRCLE"},   {8, "POSITION"},    {9, "LAND"},
    {10, "OF_LOITER"},  {11, "DRIFT"},    {13, "SPORT"},   {14, "FLIP"},       {15, "AUTOTUNE"},
    {16, "POSHOLD"},    {17, "BRAKE"},    {18, "THROW"},   {19, "AVOID_ADSB"}, {20, "GUIDED_NOGPS"},
    {21, "SMART_RTL"},  {22, "FLOWHOLD"}, {23, "FOLLOW"},  {24, "ZIGZAG"},     {25, "SYSTEMID"},
    {26, "AUTOROTATE"}, {27, "AUTO_RTL"},
};
const NamedModes kPlaneModes = {
    {0, "MANUAL"},      {1, "CIRCLE"},  {2, "STABILIZE"}, {3, "TRAINING"}, {4, "ACRO"},
    {5, "FBWA"},        {6, "FBWB"},    {7, "CRUISE"},    {8, "AUTOTUNE"}, {10, "AUTO"},
    {11, "RTL"},        {12, "LOITER"}, {13, "LAND"},     {15, "GUIDED"},  {16, "INITIALISING"},
    {17, "QSTABILIZE"}, {18, "QHOVER"}, {19, "QLOITER"},  {20, "QLAND"},   {21, "QRTL"},
};
const NamedModes kRoverModes = {
    {0, "MANUAL"},     {1, "ACRO"},    {2, "LEARNING"},      {3, "STEERING"}, {4, "HOLD"},
    {5, "LOITER"},     {6, "FOLLOW"},  {7, "SIMPLE"},        {10, "AUTO"},    {11, "RTL"},
    {12, "SMART_RTL"}, {15, "GUIDED"}, {16, "INITIALISING"},
};
const NamedModes kSubModes = {
    {0, "STABILIZE"}, {1, "ACRO"},    {2, "ALT_HOLD"}, {3, "AUTO"},    {4, "GUIDED"},
    {7, "CIRCLE"},    {9, "SURFACE"}, {16, "POSHOLD"}, {19, "MANUAL"},
};
const NamedModes kNoModes;
constexpr std::uint8_t kFirstVtol = 19, kLastVtol = 25;  // MAV_TYPE_VTOL_...

const NamedModes& ardupilot_modes(std::uint8_t type) {
  switch (type) {
    case MAV_TYPE_QUADROTOR:
    case MAV_TYPE_HEXAROTOR:
    case MAV_TYPE_OCTOROTOR:
    case MAV_TYPE_TRICOPTER:
    case MAV_TYPE_COAXIAL:
    case MAV_TYPE_HELICOPTER:
    case MAV_TYPE_DODECAROTOR:
    case MAV_TYPE_DECAROTOR:
      return kCopterModes;
    case MAV_TYPE_GROUND_ROVER:
    case MAV_TYPE_SURFACE_BOAT:
      return kRoverModes;
    case MAV_TYPE_SUBMARINE:
      return kSubModes;
    case MAV_TYPE_FIXED_WING:
      return kPlaneModes;
    default:
      return type >= kFirstVtol && type <= kLastVtol ? kPlaneModes : kNoModes;
  }
}

const NamedModes& modes_of_vehicle(std::uint8_t autopilot, std::uint8_t type) {
  if (autopilot == MAV_AUTOPILOT_PX4) return kPx4Modes;
  return autopilot == MAV_AUTOPILOT_ARDUPILOTMEGA ? ardupilot_modes(type) : kNoModes;
}

bool is_mode_number(const std::string& name) {
  constexpr std::size_t kMaxDigits = 9;
  return !name.empty() && name.size() <= kMaxDigits &&
         std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::string mode_name(std::uint8_t autopilot, std::uint8_t type, std::uint32_t custom_mode) {
  for (const NamedMode& mode : modes_of_vehicle(autopilot, type)) {
    if (mode.number == custom_mode) return mode.name;
  }
  return "CMODE(" + std::to_string(custom_mode) + ")";
}

std::optional<std::uint32_t> mode_number(std::uint8_t autopilot, std::uint8_t type,
                                         const std::string& name) {
  for (const NamedMode& mode : modes_of_vehicle(autopilot, type)) {
    if (name == mode.name) return mode.number;
  }
  if (!is_mode_number(name)) return std::nullopt;
  return static_cast<std::uint32_t>(std::stoul(name));
}

std::string mode_names_text(std::uint8_t autopilot, std::uint8_t type) {
  std::string result;
  for (const NamedMode& mode : modes_of_vehicle(autopilot, type)) {
    result += (result.empty() ? "" : ", ") + std::string(mode.name);
  }
  return result;
}

}  // namespace trident::mavros
