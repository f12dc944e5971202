// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace trident::sim {

/// What of a joint's axis may change at run time; what is not given stays. Units as of AxisSpec.
struct AxisParams {
  std::optional<double> damping;             ///< >= 0
  std::optional<double> lower, upper;        ///< limits; lower <= upper, infinite: none
  std::optional<double> cfm;                 ///< of the motor
  std::optional<double> stop_erp, stop_cfm;  ///< of the limits
  std::optional<double> fudge_factor;        ///< of a motor that pushes off a limit, [0, 1]
  std::optional<double> motor_effort;        ///< the most that the motor gives; 0: no motor
  std::optional<double> motor_velocity;      ///< what it drives at
};

}  // namespace trident::sim
