// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/parameter_table.h"

#include <algorithm>
#include <cmath>

#include "autopilot/parameter_lists.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::bridges {
namespace {

bool comes_before(const Parameter& parameter, std::string_view name) {
  return parameter.name < name;
}

std::vector<std::string> names_of(const std::vector<Parameter>& parameters) {
  std::vector<std::string> names;
  names.reserve(parameters.size());
  for (const Parameter& parameter : parameters) names.push_back(parameter.name);
  return names;
}

std::string range_text(const Parameter& parameter) {
  return number_text(parameter.min) + " to " + number_text(parameter.max) +
         (parameter.unit.empty() ? "" : " " + parameter.unit);
}

/// What a parameter chooses, as a number of GF_ACTION, which AutopilotLimits has.
int action_of(double value, const std::vector<int>& actions) {
  const auto index = static_cast<std::size_t>(std::max(0.0, value));
  return index < actions.size() ? actions[index] : 1;
}

AutopilotLimits px4_limits(const ParameterTable& table) {
  AutopilotLimits limits;
  limits.speed_m_s = table.value("MPC_XY_CRUISE");
  limits.climb_m_s = table.value("MPC_Z_VEL_MAX_UP");
  limits.sink_m_s = table.value("MPC_Z_VEL_MAX_DN");
  limits.land_speed_m_s = table.value("MPC_LAND_SPEED");
  limits.acceleration_m_s2 = table.value("MPC_ACC_HOR");
  limits.yaw_rate_rad_s = deg_to_rad(table.value("MPC_YAWRAUTO_MAX"));
  limits.acceptance_radius_m = table.value("NAV_ACC_RAD");
  limits.take_off_height_m = table.value("MIS_TAKEOFF_ALT");
  limits.return_height_m = table.value("RTL_RETURN_ALT");
  limits.return_loiter_s = std::max(0.0, table.value("RTL_LAND_DELAY"));
  limits.disarm_after_landing_s = std::max(0.0, table.value("COM_DISARM_LAND"));
  limits.low_battery = table.value("BAT_LOW_THR");
  limits.critical_battery = table.value("BAT_CRIT_THR");
  limits.arming_battery = table.value("BAT_LOW_THR");
  limits.offboard_loss_s = table.value("COM_OF_LOSS_T");
  limits.ground_station_loss_s = table.value("COM_DL_LOSS_T");
  limits.ground_station_loss_action = action_of(table.value("NAV_DLL_ACT"), {0, 2, 3, 5});
  limits.fence_radius_m = table.value("GF_MAX_HOR_DIST");
  limits.fence_height_m = table.value("GF_MAX_VER_DIST");
  limits.fence_action = static_cast<int>(table.value("GF_ACTION"));
  limits.fence_is_on = limits.fence_action != 0;
  limits.sticks_override = table.value("COM_RC_OVERRIDE") != 0.0;
  limits.stick_dead_band = 0.01 * table.value("COM_RC_STICK_OV");
  return limits;
}

AutopilotLimits ardupilot_limits(const ParameterTable& table, VehicleClass vehicle) {
  AutopilotLimits limits;
  limits.low_battery = table.value("BATT_LOW_PCT") / 100.0;
  limits.critical_battery = table.value("BATT_CRT_PCT") / 100.0;
  limits.arming_battery = limits.low_battery;
  limits.offboard_loss_s = 3.0;
  limits.ground_station_loss_s = table.value("FS_GCS_TIMEOUT");
  limits.fence_is_on = table.value("FENCE_ENABLE") != 0.0;
  limits.fence_radius_m = table.value("FENCE_RADIUS");
  limits.checks_arming = table.value("ARMING_CHECK") != 0.0;
  limits.stick_dead_band = 0.3;
  if (vehicle != VehicleClass::kMultirotor) {
    limits.ground_station_loss_action = action_of(table.value("FS_GCS_ENABLE"), {0, 3, 3});
    limits.fence_action = action_of(table.value("FENCE_ACTION"), {1, 3, 2});
    limits.speed_m_s = table.value("WP_SPEED");
    limits.acceptance_radius_m = table.value("WP_RADIUS");
    limits.acceleration_m_s2 = table.value("ATC_ACCEL_MAX");
    return limits;
  }
  limits.ground_station_loss_action = action_of(table.value("FS_GCS_ENABLE"), {0, 3, 3, 3, 3, 5});
  limits.fence_action = action_of(table.value("FENCE_ACTION"), {1, 3, 5, 3, 2});
  limits.fence_height_m = table.value("FENCE_ALT_MAX");
  limits.speed_m_s = table.value("WPNAV_SPEED") / 100.0;
  limits.climb_m_s = table.value("WPNAV_SPEED_UP") / 100.0;
  limits.sink_m_s = table.value("WPNAV_SPEED_DN") / 100.0;
  limits.acceleration_m_s2 = table.value("WPNAV_ACCEL") / 100.0;
  limits.acceptance_radius_m = table.value("WPNAV_RADIUS") / 100.0;
  limits.land_speed_m_s = table.value("LAND_SPEED") / 100.0;
  limits.return_height_m = table.value("RTL_ALT") / 100.0;
  limits.return_loiter_s = table.value("RTL_LOIT_TIME") / 1000.0;
  limits.disarm_after_landing_s = 2.0;
  return limits;
}

}  // namespace

ParameterTable::ParameterTable(Flavor flavor, VehicleClass vehicle, int system_id)
    : parameters_(default_parameters(flavor, vehicle)) {
  std::sort(parameters_.begin(), parameters_.end(),
            [](const Parameter& a, const Parameter& b) { return a.name < b.name; });
  set(flavor == Flavor::kPx4 ? "MAV_SYS_ID" : "SYSID_THISMAV", system_id);
}

const Parameter* ParameterTable::find(std::string_view name) const {
  const auto found = std::lower_bound(parameters_.begin(), parameters_.end(), name, comes_before);
  return found != parameters_.end() && found->name == name ? &*found : nullptr;
}

double ParameterTable::value(std::string_view name) const {
  if (const Parameter* const parameter = find(name)) return parameter->value;
  throw Error("unknown parameter " + unknown_name_text(name, names_of(parameters_)));
}

Answer ParameterTable::set(std::string_view name, double value) {
  const Parameter* const found = find(name);
  if (found == nullptr) {
    return denied("parameter: unknown " + unknown_name_text(name, names_of(parameters_)));
  }
  if (!(value >= found->min && value <= found->max)) {
    return denied(found->name + ": " + number_text(value) + ", legal: " + range_text(*found));
  }
  if (found->is_integer && value != std::floor(value)) {
    return denied(found->name + ": " + number_text(value) + ", legal: whole numbers, " +
                  range_text(*found));
  }
  parameters_[static_cast<std::size_t>(found - parameters_.data())].value = value;
  return {};
}

AutopilotLimits limits_of(const ParameterTable& table, Flavor flavor, VehicleClass vehicle) {
  if (flavor == Flavor::kArduPilot) return ardupilot_limits(table, vehicle);
  AutopilotLimits limits = px4_limits(table);
  if (vehicle != VehicleClass::kMultirotor) limits.speed_m_s = table.value("GND_SPEED_TRIM");
  return limits;
}

}  // namespace trident::bridges
