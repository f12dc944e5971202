// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trident_bridges/autopilot/answer.h"
#include "trident_bridges/autopilot/vehicle.h"

namespace trident::bridges {

/// One parameter as a ground station sees it.
struct Parameter {
  std::string name;         ///< up to 16 characters
  double value = 0.0;       ///< an integer's is whole
  double min = 0.0;         ///< least legal value
  double max = 0.0;         ///< greatest legal value
  bool is_integer = false;  ///< MAV_PARAM_TYPE_INT32, else REAL32
  std::string unit;         ///< "" for counts and choices
  std::string meaning;      ///< what it decides
  bool is_used = true;      ///< false: kept for ground stations, without effect here
};

/// The parameters of one vehicle, ordered by name, with the names and units of its flavor.
class ParameterTable {
 public:
  /// With the defaults of the flavor.
  ParameterTable(Flavor flavor, VehicleClass vehicle, int system_id);

  /// Ordered by name; PARAM_VALUE.param_index counts in this order.
  const std::vector<Parameter>& all() const { return parameters_; }
  /// nullptr: the name is not known.
  const Parameter* find(std::string_view name) const;
  /// Value of a parameter that the table has. Throws Error otherwise.
  double value(std::string_view name) const;
  /// Changes one. Refused: an unknown name (the nearest one is named), a value that is not finite,
  /// not whole or out of its range.
  Answer set(std::string_view name, double value);

 private:
  std::vector<Parameter> parameters_;
};

/// What the autopilot uses of them, in SI units and fractions, whatever the flavor calls it.
struct AutopilotLimits {
  double speed_m_s = 5.0;               ///< along legs
  double climb_m_s = 2.5;               ///< upwards
  double sink_m_s = 1.5;                ///< downwards
  double land_speed_m_s = 0.7;          ///< of the last meters
  double acceleration_m_s2 = 2.5;       ///< horizontal and vertical
  double yaw_rate_rad_s = 0.785;        ///< turning towards a leg
  double acceptance_radius_m = 2.0;     ///< a waypoint counts as reached within it
  double take_off_height_m = 2.5;       ///< where the command does not say
  double return_height_m = 15.0;        ///< above home, while returning
  double return_loiter_s = 5.0;         ///< above home, before landing
  double disarm_after_landing_s = 2.0;  ///< 0: never by itself
  double low_battery = 0.20;            ///< return below
  double critical_battery = 0.07;       ///< land below
  double arming_battery = 0.20;         ///< no arming below
  double offboard_loss_s = 1.0;         ///< set-points may be missing for that long
  double ground_station_loss_s = 10.0;  ///< heartbeats may be missing for that long
  int ground_station_loss_action = 0;   ///< as fence_action
  bool fence_is_on = true;              ///< whether what the fence says counts
  double fence_radius_m = 0.0;          ///< around home; 0: none
  double fence_height_m = 0.0;          ///< above home; 0: none
  int fence_action = 2;                 ///< 0 none, 1 reported only, 2 hold, 3 return, 5 land
  bool sticks_override = true;          ///< sticks take over from AUTO and OFFBOARD
  double stick_dead_band = 0.3;         ///< of full travel
  bool checks_arming = true;            ///< false: arms whatever the checks say
};

/// Reads them from the table of a vehicle.
AutopilotLimits limits_of(const ParameterTable& table, Flavor flavor, VehicleClass vehicle);

}  // namespace trident::bridges
