// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_control/limited_integral.h"
#include "trident_control/vessel_control_params.h"
#include "trident_control/vessel_model.h"

namespace trident::control {

/// Turns a vessel to a heading. A third-order reference model with limits of rate and acceleration
/// leads there (Fossen 2011, 12.1.1); a PID with the model's acceleration and the vessel's drag as
/// feed-forward follows it (12.2.6): with m the inertia about z with added mass,
///   N = m (a_d + 2 zeta w_n (r_d - r) + w_n^2 (psi_d - psi)) + drag(r_d) + integral.
class HeadingAutopilot {
 public:
  /// The gains follow from the model's mass and drag in yaw; both are copied.
  HeadingAutopilot(const HeadingParams& params, const VesselModel& model);

  /// Begins from how the vessel moves now.
  void reset(const VesselState& state);
  /// Moment [N m] that leads to the heading `target` [rad].
  double hold(const VesselState& state, double target, double dt_s);
  /// Moment [N m] that turns with `rate` [rad/s]; a heading is held when it is 0.
  double turn(const VesselState& state, double rate, double dt_s);
  /// What the actuators gave of the last moment; the integral continues from it.
  void settle(double given);

  /// The heading that is asked for at present [rad].
  double reference() const { return heading_; }

 private:
  double follow(const VesselState& state, double dt_s);

  HeadingParams params_;
  VesselModel model_;
  double heading_ = 0.0, rate_ = 0.0, acceleration_ = 0.0;  // of the reference model
  double error_ = 0.0, asked_ = 0.0, dt_s_ = 0.0;
  LimitedIntegral integral_;
};

}  // namespace trident::control
