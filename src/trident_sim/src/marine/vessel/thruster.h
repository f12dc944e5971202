// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_base/se3.h"
#include "trident_base/vehicle/thruster_curve.h"

namespace trident::sim {

/// A propeller that follows its command with a first-order lag and then makes thrust_at() of what
/// it does (a command, or [rad/s] where the command is one).
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

}  // namespace trident::sim
