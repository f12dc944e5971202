// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "thruster_params.h"
#include "trident_base/se3.h"

namespace trident {

/// VRX' generalised logistic function, thrust [N] of a command in [-1, 1]:
/// T = A + (K - A) / (C + exp(-B (x - M)))^(1 / nu), one set of constants ahead (x > 0.01), one
/// astern (x < -0.01), nothing between.
double vrx_glf_thrust(double command);

/// A propeller that follows its command with a first-order lag and then makes thrust of what it
/// does: of the state n (a command, or [rad/s] where the command is one)
///   linear     n / max_command max_force_forward, or n / |min_command| max_force_reverse
///   glf        vrx_glf_thrust(n)
///   quadratic  K n|n|, K for either direction
///   table      linear between the points, constant beyond them
/// cut to [-max_force_reverse, max_force_forward].
class Thruster {
 public:
  explicit Thruster(const ThrusterParams& params);

  const ThrusterParams& params() const { return params_; }
  /// What is wrong with a command: empty when nothing is.
  std::string check_command(double command) const;
  /// Throws Error when it is not finite, and the last one stays; cuts what is beyond the limits.
  void command(double value);
  /// Azimuth from the thruster's own yaw [rad]; the same rules.
  void command_angle(double angle_rad);
  void step(double dt_s);
  void reset();

  double command_value() const { return command_; }
  double state_value() const { return state_; }
  double angle_rad() const { return angle_rad_; }
  double thrust_n() const;
  /// Thrust at a propeller state, e.g. to invert the mapping for allocation.
  double thrust_at(double state) const;
  /// About CO, body axes.
  Vector6d wrench() const;

  template <class Archive>
  void state(Archive& archive) {
    archive(command_, state_, command_angle_rad_, angle_rad_);
  }

 private:
  ThrusterParams params_;
  double command_ = 0.0, state_ = 0.0;
  double command_angle_rad_ = 0.0, angle_rad_ = 0.0;
};

}  // namespace trident
