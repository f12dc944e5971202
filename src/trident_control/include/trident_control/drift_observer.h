// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "trident_control/vessel_model.h"

namespace trident::control {

/// What carries a vessel along that moves through the water by its own model: the current, and
/// what wind and waves add to it. The model's sway (pushed aside by the turn's own centripetal
/// force, slowed by the drag) less the measured one is how fast the water moves across the bow;
/// that part of a vector of the world's axes is averaged. The part along the bow stays as it was
/// learned on another heading: a surge speed over ground alone does not determine it.
class DriftObserver {
 public:
  /// `time_constant` of the average [s], > 0.
  DriftObserver(const VesselModel& model, double time_constant)
      : model_(model), time_constant_(time_constant) {}

  /// No drift is known.
  void reset();
  /// `sway_force`: what the thrusters gave since the last state [N].
  void update(const VesselState& state, double sway_force, double dt_s);
  /// To the left through the water [m/s].
  double sway() const { return sway_; }
  /// In the world's axes [m/s].
  const Eigen::Vector2d& drift() const { return drift_world_; }

 private:
  VesselModel model_;
  double time_constant_;
  double sway_ = 0.0;  // through the water [m/s]
  Eigen::Vector2d drift_world_ = Eigen::Vector2d::Zero();
};

}  // namespace trident::control
