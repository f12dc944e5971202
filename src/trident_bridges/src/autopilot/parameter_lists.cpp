// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "autopilot/parameter_lists.h"

namespace trident::bridges {
namespace {

using List = std::vector<Parameter>;

constexpr bool kWhole = true;
constexpr bool kReal = false;
constexpr bool kUsed = true;
constexpr bool kForShow = false;

void append(List& list, const List& more) { list.insert(list.end(), more.begin(), more.end()); }

// Names and units of PX4 1.14's parameter reference; defaults too, where nothing of ours asks for
// others (batteries: 20 % and 7 %).
const List kPx4Parameters = {
    {"BAT1_CAPACITY", -1, -1, 1e5, kReal, "mAh", "capacity of the battery", kForShow},
    {"BAT1_N_CELLS", 4, 0, 16, kWhole, "", "cells in series", kForShow},
    {"BAT_CRIT_THR", 0.07, 0.05, 0.25, kReal, "", "land below this filling", kUsed},
    {"BAT_EMERGEN_THR", 0.05, 0.03, 0.1, kReal, "", "filling of an emergency", kForShow},
    {"BAT_LOW_THR", 0.20, 0.1, 0.5, kReal, "", "return below this filling, no arming", kUsed},
    {"CBRK_IO_SAFETY", 22027, 0, 22027, kWhole, "", "no safety switch", kForShow},
    {"CBRK_SUPPLY_CHK", 894281, 0, 894281, kWhole, "", "no check of the supply", kForShow},
    {"CBRK_USB_CHK", 197848, 0, 197848, kWhole, "", "no check of USB", kForShow},
    {"COM_ARM_WO_GPS", 1, 0, 1, kWhole, "", "arming without GNSS", kForShow},
    {"COM_DISARM_LAND", 2, -1, 20, kReal, "s", "disarms that long after landing; -1: never", kUsed},
    {"COM_DISARM_PRFLT", 10, -1, 60, kReal, "s", "disarms when it does not take off", kForShow},
    {"COM_DL_LOSS_T", 10, 5, 300, kWhole, "s", "silence of the ground station", kUsed},
    {"COM_FLTMODE1", -1, -1, 20, kWhole, "", "mode of a switch", kForShow},
    {"COM_LOW_BAT_ACT", 3, 0, 3, kWhole, "", "what an empty battery does", kForShow},
    {"COM_OBL_RC_ACT", 0, 0, 7, kWhole, "", "after OFFBOARD is lost: 0 POSCTL", kForShow},
    {"COM_OF_LOSS_T", 1, 0, 60, kReal, "s", "set-points may be missing for that long", kUsed},
    {"COM_RC_IN_MODE", 3, 0, 4, kWhole, "", "where sticks come from", kForShow},
    {"COM_RC_LOSS_T", 0.5, 0, 35, kReal, "s", "silence of the sticks", kForShow},
    {"COM_RC_OVERRIDE", 3, 0, 7, kWhole, "", "sticks take over from AUTO and OFFBOARD", kUsed},
    {"COM_RC_STICK_OV", 30, 5, 80, kReal, "%", "travel of a stick that takes over", kUsed},
    {"GF_ACTION", 2, 0, 5, kWhole, "", "fence: 0 off, 1 reported, 2 hold, 3 return, 5 land", kUsed},
    {"GF_MAX_HOR_DIST", 0, 0, 10000, kReal, "m", "fence around home; 0: none", kUsed},
    {"GF_MAX_VER_DIST", 0, 0, 10000, kReal, "m", "fence above home; 0: none", kUsed},
    {"MAV_COMP_ID", 1, 1, 250, kWhole, "", "component", kForShow},
    {"MAV_PROTO_VER", 2, 0, 2, kWhole, "", "version of MAVLink", kForShow},
    {"MAV_SYS_ID", 1, 1, 255, kWhole, "", "system", kForShow},
    {"MIS_DIST_1WP", 900, -1, 1e5, kReal, "m", "greatest distance to the first waypoint", kForShow},
    {"MIS_TAKEOFF_ALT", 2.5, 0, 80, kReal, "m", "height of a take-off", kUsed},
    {"NAV_ACC_RAD", 2, 0.05, 200, kReal, "m", "a waypoint counts as reached within it", kUsed},
    {"NAV_DLL_ACT", 0, 0, 3, kWhole, "", "ground station lost: 0 no, 1 hold, 2 return, 3 land",
     kUsed},
    {"NAV_MC_ALT_RAD", 0.8, 0.05, 200, kReal, "m", "the same in height", kForShow},
    {"NAV_RCL_ACT", 2, 1, 6, kWhole, "", "what lost sticks do", kForShow},
    {"RTL_DESCEND_ALT", 30, 2, 100, kReal, "m", "loiter above home", kForShow},
    {"RTL_LAND_DELAY", 0, -1, 300, kReal, "s", "waits above home", kUsed},
    {"RTL_RETURN_ALT", 15, 0, 150, kReal, "m", "height above home of the return", kUsed},
    {"RTL_TYPE", 0, 0, 3, kWhole, "", "kind of return", kForShow},
    {"SYS_AUTOCONFIG", 0, 0, 1, kWhole, "", "reset to defaults", kForShow},
    {"SYS_AUTOSTART", 10016, 0, 99999, kWhole, "", "airframe", kForShow},
    {"SYS_HITL", 0, -1, 2, kWhole, "", "hardware in the loop", kForShow},
};
const List kPx4MultirotorParameters = {
    {"MPC_ACC_DOWN_MAX", 3, 2, 15, kReal, "m/s^2", "acceleration downwards", kForShow},
    {"MPC_ACC_HOR", 3, 2, 15, kReal, "m/s^2", "acceleration", kUsed},
    {"MPC_ACC_UP_MAX", 4, 2, 15, kReal, "m/s^2", "acceleration upwards", kForShow},
    {"MPC_LAND_SPEED", 0.7, 0.6, 2, kReal, "m/s", "speed of the last meters down", kUsed},
    {"MPC_THR_HOVER", 0.5, 0.1, 0.8, kReal, "", "thrust of hovering", kForShow},
    {"MPC_TKO_SPEED", 1.5, 1, 5, kReal, "m/s", "speed of a take-off", kForShow},
    {"MPC_XY_CRUISE", 5, 3, 20, kReal, "m/s", "speed along legs", kUsed},
    {"MPC_XY_VEL_MAX", 12, 0, 20, kReal, "m/s", "greatest speed", kForShow},
    {"MPC_YAWRAUTO_MAX", 45, 0, 360, kReal, "deg/s", "turning towards a leg", kUsed},
    {"MPC_Z_VEL_MAX_DN", 1.5, 0.5, 4, kReal, "m/s", "sinking", kUsed},
    {"MPC_Z_VEL_MAX_UP", 3, 0.5, 8, kReal, "m/s", "climbing", kUsed},
};
const List kPx4RoverParameters = {
    {"GND_SPEED_MAX", 10, 0, 40, kReal, "m/s", "greatest speed", kForShow},
    {"GND_SPEED_TRIM", 2, 0, 40, kReal, "m/s", "speed along legs", kUsed},
    {"MPC_ACC_HOR", 3, 2, 15, kReal, "m/s^2", "acceleration", kUsed},
    {"MPC_LAND_SPEED", 0.7, 0.6, 2, kReal, "m/s", "kept for ground stations", kForShow},
    {"MPC_XY_CRUISE", 5, 3, 20, kReal, "m/s", "kept for ground stations", kForShow},
    {"MPC_YAWRAUTO_MAX", 45, 0, 360, kReal, "deg/s", "turning towards a leg", kForShow},
    {"MPC_Z_VEL_MAX_DN", 1.5, 0.5, 4, kReal, "m/s", "kept for ground stations", kForShow},
    {"MPC_Z_VEL_MAX_UP", 3, 0.5, 8, kReal, "m/s", "kept for ground stations", kForShow},
};

// Names and units of ArduPilot 4.6's parameter lists. The two of the battery in per cent are ours:
// ArduPilot counts volts and mAh.
const List kArduPilotParameters = {
    {"ARMING_CHECK", 1, 0, 1048575, kWhole, "", "0: arms whatever the checks say", kUsed},
    {"ARMING_REQUIRE", 1, 0, 2, kWhole, "", "arming is needed", kForShow},
    {"BATT_CAPACITY", 3300, 0, 1e6, kWhole, "mAh", "capacity of the battery", kForShow},
    {"BATT_CRT_PCT", 7, 0, 50, kReal, "%", "land (copter) or hold below this filling", kUsed},
    {"BATT_CRT_VOLT", 0, 0, 100, kReal, "V", "critical voltage", kForShow},
    {"BATT_FS_CRT_ACT", 1, 0, 7, kWhole, "", "what a critical battery does", kForShow},
    {"BATT_FS_LOW_ACT", 2, 0, 7, kWhole, "", "what a low battery does", kForShow},
    {"BATT_LOW_PCT", 20, 0, 80, kReal, "%", "return below this filling, no arming", kUsed},
    {"BATT_LOW_VOLT", 10.5, 0, 100, kReal, "V", "low voltage", kForShow},
    {"BATT_MONITOR", 4, 0, 30, kWhole, "", "kind of battery monitor", kForShow},
    {"COMPASS_USE", 1, 0, 1, kWhole, "", "the compass counts", kForShow},
    {"FENCE_ACTION", 1, 0, 5, kWhole, "", "what a broken fence does", kUsed},
    {"FENCE_ENABLE", 0, 0, 1, kWhole, "", "the fence counts", kUsed},
    {"FENCE_RADIUS", 300, 5, 1e5, kReal, "m", "fence around home", kUsed},
    {"FENCE_TOTAL", 0, 0, 255, kWhole, "", "corners of the fence", kForShow},
    {"FENCE_TYPE", 7, 0, 15, kWhole, "", "kinds of fence", kForShow},
    {"FS_GCS_ENABLE", 0, 0, 7, kWhole, "", "ground station lost: 0 nothing, 1 return, 5 land",
     kUsed},
    {"FS_GCS_TIMEOUT", 5, 2, 120, kReal, "s", "silence of the ground station", kUsed},
    {"FS_THR_ENABLE", 0, 0, 7, kWhole, "", "what lost sticks do", kForShow},
    {"GPS_TYPE", 1, 0, 25, kWhole, "", "kind of GNSS receiver", kForShow},
    {"LOG_BITMASK", 0, 0, 1e6, kWhole, "", "what is logged", kForShow},
    {"MIS_OPTIONS", 0, 0, 255, kWhole, "", "habits of missions", kForShow},
    {"MIS_RESTART", 0, 0, 1, kWhole, "", "a mission starts again", kForShow},
    {"MIS_TOTAL", 0, 0, 32766, kWhole, "", "items of the mission", kForShow},
    {"RC1_MAX", 1900, 800, 2200, kWhole, "us", "end of a channel", kForShow},
    {"RC1_MIN", 1100, 800, 2200, kWhole, "us", "begin of a channel", kForShow},
    {"RC1_TRIM", 1500, 800, 2200, kWhole, "us", "middle of a channel", kForShow},
    {"RC2_TRIM", 1500, 800, 2200, kWhole, "us", "middle of a channel", kForShow},
    {"RC3_MIN", 1100, 800, 2200, kWhole, "us", "begin of a channel", kForShow},
    {"RC3_TRIM", 1500, 800, 2200, kWhole, "us", "middle of a channel", kForShow},
    {"RC4_TRIM", 1500, 800, 2200, kWhole, "us", "middle of a channel", kForShow},
    {"SIM_SPEEDUP", 1, 0, 1000, kReal, "", "the world's real_time_factor decides", kForShow},
    {"SR0_EXTRA1", 25, 0, 50, kWhole, "Hz", "rate of attitudes", kForShow},
    {"SR0_POSITION", 10, 0, 50, kWhole, "Hz", "rate of positions", kForShow},
    {"SYSID_ENFORCE", 0, 0, 1, kWhole, "", "only one ground station", kForShow},
    {"SYSID_MYGCS", 255, 1, 255, kWhole, "", "system of the ground station", kForShow},
    {"SYSID_THISMAV", 1, 1, 255, kWhole, "", "system", kForShow},
};
const List kCopterParameters = {
    {"ANGLE_MAX", 3000, 1000, 8000, kWhole, "cdeg", "greatest lean", kForShow},
    {"DISARM_DELAY", 10, 0, 127, kWhole, "s", "disarms when it does not take off", kForShow},
    {"FENCE_ALT_MAX", 100, 10, 1000, kReal, "m", "fence above home", kUsed},
    {"FRAME_CLASS", 1, 0, 17, kWhole, "", "kind of frame", kForShow},
    {"FRAME_TYPE", 1, 0, 19, kWhole, "", "order of the rotors", kForShow},
    {"GUID_TIMEOUT", 3, 0.1, 5, kReal, "s", "velocities without news", kForShow},
    {"LAND_SPEED", 50, 30, 200, kReal, "cm/s", "speed of the last meters down", kUsed},
    {"PILOT_SPEED_UP", 250, 50, 500, kReal, "cm/s", "climbing by sticks", kForShow},
    {"RTL_ALT", 1500, 30, 300000, kReal, "cm", "height above home of the return", kUsed},
    {"RTL_ALT_FINAL", 0, 0, 1000, kReal, "cm", "end of the return; 0: lands", kForShow},
    {"RTL_LOIT_TIME", 5000, 0, 60000, kReal, "ms", "waits above home", kUsed},
    {"WPNAV_ACCEL", 250, 50, 500, kReal, "cm/s^2", "acceleration", kUsed},
    {"WPNAV_RADIUS", 200, 5, 1000, kReal, "cm", "a waypoint counts as reached within it", kUsed},
    {"WPNAV_SPEED", 500, 20, 2000, kReal, "cm/s", "speed along legs", kUsed},
    {"WPNAV_SPEED_DN", 150, 10, 500, kReal, "cm/s", "sinking", kUsed},
    {"WPNAV_SPEED_UP", 250, 10, 1000, kReal, "cm/s", "climbing", kUsed},
};
const List kRoverParameters = {
    {"ATC_ACCEL_MAX", 1, 0, 10, kReal, "m/s^2", "acceleration", kUsed},
    {"ATC_STR_RAT_MAX", 120, 0, 1000, kReal, "deg/s", "turning", kForShow},
    {"CRUISE_SPEED", 2, 0, 100, kReal, "m/s", "speed that the throttle is learnt for", kForShow},
    {"FRAME_CLASS", 1, 0, 3, kWhole, "", "1 rover, 2 boat", kForShow},
    {"INITIAL_MODE", 0, 0, 15, kWhole, "", "mode after start", kForShow},
    {"TURN_RADIUS", 0.9, 0, 10, kReal, "m", "turning circle", kForShow},
    {"WP_RADIUS", 2, 0, 100, kReal, "m", "a waypoint counts as reached within it", kUsed},
    {"WP_SPEED", 2, 0, 100, kReal, "m/s", "speed along legs", kUsed},
};

}  // namespace

std::vector<Parameter> default_parameters(Flavor flavor, VehicleClass vehicle) {
  const bool flies = vehicle == VehicleClass::kMultirotor;
  List list = flavor == Flavor::kPx4 ? kPx4Parameters : kArduPilotParameters;
  if (flavor == Flavor::kPx4) {
    append(list, flies ? kPx4MultirotorParameters : kPx4RoverParameters);
  } else {
    append(list, flies ? kCopterParameters : kRoverParameters);
  }
  return list;
}

}  // namespace trident::bridges
