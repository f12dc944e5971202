// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/modes.h"

#include <algorithm>

namespace trident::bridges {
namespace {

/// PX4's custom mode: main mode, and sub mode of AUTO.
constexpr std::uint32_t px4(std::uint32_t main, std::uint32_t sub = 0) {
  return main << 16 | sub << 24;
}

// px4_custom_mode.h of PX4, as the names of mavros are.
const std::vector<ModeEntry> kPx4Multirotor = {
    {Mode::kManual, px4(1), "MANUAL"},
    {Mode::kAltitude, px4(2), "ALTCTL"},
    {Mode::kPosition, px4(3), "POSCTL"},
    {Mode::kTakeOff, px4(4, 2), "AUTO.TAKEOFF"},
    {Mode::kHold, px4(4, 3), "AUTO.LOITER"},
    {Mode::kMission, px4(4, 4), "AUTO.MISSION"},
    {Mode::kReturn, px4(4, 5), "AUTO.RTL"},
    {Mode::kLand, px4(4, 6), "AUTO.LAND"},
    {Mode::kAcro, px4(5), "ACRO"},
    {Mode::kOffboard, px4(6), "OFFBOARD"},
    {Mode::kStabilize, px4(7), "STABILIZED"},
};
const std::vector<ModeEntry> kPx4Rover = {
    {Mode::kManual, px4(1), "MANUAL"},           {Mode::kHold, px4(4, 3), "AUTO.LOITER"},
    {Mode::kMission, px4(4, 4), "AUTO.MISSION"}, {Mode::kReturn, px4(4, 5), "AUTO.RTL"},
    {Mode::kOffboard, px4(6), "OFFBOARD"},
};
// ArduCopter's mode.h and Rover's mode.h.
const std::vector<ModeEntry> kCopter = {
    {Mode::kStabilize, 0, "STABILIZE"}, {Mode::kAcro, 1, "ACRO"},
    {Mode::kAltitude, 2, "ALT_HOLD"},   {Mode::kMission, 3, "AUTO"},
    {Mode::kGuided, 4, "GUIDED"},       {Mode::kPosition, 5, "LOITER"},
    {Mode::kReturn, 6, "RTL"},          {Mode::kLand, 9, "LAND"},
    {Mode::kBrake, 17, "BRAKE"},        {Mode::kReturn, 21, "SMART_RTL"},
};
const std::vector<ModeEntry> kRover = {
    {Mode::kManual, 0, "MANUAL"},  {Mode::kHold, 4, "HOLD"},   {Mode::kHold, 5, "LOITER"},
    {Mode::kMission, 10, "AUTO"},  {Mode::kReturn, 11, "RTL"}, {Mode::kReturn, 12, "SMART_RTL"},
    {Mode::kGuided, 15, "GUIDED"},
};

template <class Matches>
const ModeEntry* find(Flavor flavor, VehicleClass vehicle, const Matches& matches) {
  const auto& modes = modes_of(flavor, vehicle);
  const auto found = std::find_if(modes.begin(), modes.end(), matches);
  return found == modes.end() ? nullptr : &*found;
}

}  // namespace

const std::vector<ModeEntry>& modes_of(Flavor flavor, VehicleClass vehicle) {
  const bool flies = vehicle == VehicleClass::kMultirotor;
  if (flavor == Flavor::kPx4) return flies ? kPx4Multirotor : kPx4Rover;
  return flies ? kCopter : kRover;
}

const ModeEntry* find_mode(Flavor flavor, VehicleClass vehicle, std::uint32_t custom_mode) {
  return find(flavor, vehicle, [&](const auto& mode) { return mode.custom_mode == custom_mode; });
}

const ModeEntry* find_mode(Flavor flavor, VehicleClass vehicle, std::string_view name) {
  return find(flavor, vehicle, [&](const auto& mode) { return name == mode.name; });
}

const ModeEntry* find_mode(Flavor flavor, VehicleClass vehicle, Mode wanted) {
  return find(flavor, vehicle, [&](const auto& mode) { return mode.mode == wanted; });
}

std::vector<std::string> mode_names(Flavor flavor, VehicleClass vehicle) {
  std::vector<std::string> names;
  for (const ModeEntry& mode : modes_of(flavor, vehicle)) names.emplace_back(mode.name);
  return names;
}

bool is_manual(Mode mode) {
  return mode == Mode::kManual || mode == Mode::kStabilize || mode == Mode::kAcro ||
         mode == Mode::kAltitude || mode == Mode::kPosition;
}

bool follows_targets(Mode mode) { return mode == Mode::kOffboard || mode == Mode::kGuided; }

bool prevents_arming(Mode mode) { return mode == Mode::kReturn || mode == Mode::kLand; }

bool needs_position(Mode mode) {
  return !(mode == Mode::kManual || mode == Mode::kStabilize || mode == Mode::kAcro ||
           mode == Mode::kAltitude);
}

}  // namespace trident::bridges
