// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "trident_control/limited_integral.h"
#include "trident_control/vessel_control_params.h"
#include "trident_control/vessel_model.h"

namespace trident::control {

/// Holds a surge speed: the vessel's drag and inertia at a ramped reference as feed-forward, and a
/// PI on what is missing:
///   X = m (a_d + (u_d - u) / T) + drag(u_d) + integral.
class SurgeSpeedController {
 public:
  /// The gains follow from the model's mass and drag in surge; both are copied.
  SurgeSpeedController(const SpeedParams& params, const VesselModel& model);

  /// The reference begins at `speed` [m/s], without an integral.
  void reset(double speed);
  /// Force [N] that leads to `target` [m/s]. `measured`: the surge speed of the kind that the
  /// parameters name; without one the feed-forward stands alone.
  double hold(std::optional<double> measured, double target, double dt_s);
  /// What the actuators gave of the last force.
  void settle(double given);

 private:
  SpeedParams params_;
  VesselModel model_;
  double speed_ = 0.0;  // the reference
  double error_ = 0.0, asked_ = 0.0, dt_s_ = 0.0;
  LimitedIntegral integral_;
};

}  // namespace trident::control
