// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/se3.h"
#include "trident_base/vehicle/rudder_params.h"

namespace trident::sim {

/// Lift of a wing of low aspect ratio (Helmbold), C_L = 2 pi A / (2 + sqrt(A^2 + 4)) alpha, up to
/// the stall angle, beyond it a flat plate's normal force; drag C_D0 + C_L^2 / (0.9 pi A).
class Rudder {
 public:
  explicit Rudder(const RudderParams& params) : params_(params) {}

  const RudderParams& params() const { return params_; }
  double angle_rad() const { return angle_rad_; }
  /// Throws Error when the angle [rad] is not finite; one beyond the legal ones is cut.
  void command(double angle_rad);
  void step(double dt_s);
  void reset() { command_rad_ = angle_rad_ = 0.0; }

  /// About CO, body axes, from the velocity of CO through the water.
  Vector6d wrench(const Vector6d& nu_r, double water_density) const;

  template <class Archive>
  void state(Archive& archive) {
    archive(command_rad_, angle_rad_);
  }

 private:
  RudderParams params_;
  double command_rad_ = 0.0, angle_rad_ = 0.0;
};

}  // namespace trident::sim
