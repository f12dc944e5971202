// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/span.h"
#include "trident_control/attitude_law.h"
#include "trident_control/control_types.h"
#include "trident_control/vehicle_params.h"

namespace trident::control {

/// What RollPitchYawrateThrustController is made from.
struct RollPitchYawrateThrustParams {
  AttitudeGains gains;    ///< of attitude and angular rate
  VehicleParams vehicle;  ///< inertia and rotors that it reckons with
  AttitudeQuirks quirks;  ///< where it keeps RotorS' departures from the paper
};

/// Holds commanded roll and pitch at the vehicle's present heading, turns at the commanded yaw
/// rate, and applies the commanded thrust: Rd = Rz(present yaw) Rx(roll) Ry(pitch), then
/// AttitudeLaw.
class RollPitchYawrateThrustController {
 public:
  /// Throws trident::Error naming the field, value and legal range.
  explicit RollPitchYawrateThrustController(const RollPitchYawrateThrustParams& params);

  /// Length of compute()'s output.
  std::size_t rotor_count() const { return attitude_law_.rotor_count(); }

  /// `rotor_speeds`: rotor_count() values [rad/s, >= 0], untouched unless the result is ok.
  [[nodiscard]] ControlStatus compute(const OdometryState& state, const AttitudeCommand& command,
                                      Span<double> rotor_speeds) const;

 private:
  AttitudeLaw attitude_law_;
};

}  // namespace trident::control
