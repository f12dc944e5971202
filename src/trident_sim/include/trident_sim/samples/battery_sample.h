// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// State of a battery as its monitor reports it (sensor_msgs/BatteryState).
struct BatterySample {
  SimTime stamp;                     ///< of the state
  double voltage_v = 0.0;            ///< at its terminals, under load
  double current_a = 0.0;            ///< drawn from it, >= 0
  double charge_ah = 0.0;            ///< that is left
  double capacity_ah = 0.0;          ///< when full
  double charge_share = 0.0;         ///< charge_ah / capacity_ah, 0 to 1
  std::vector<float> cell_voltages;  ///< of each cell in series [V]
};

}  // namespace trident::sim
