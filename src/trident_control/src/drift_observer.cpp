// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/drift_observer.h"

#include <algorithm>
#include <cmath>

namespace trident::control {

void DriftObserver::reset() {
  sway_ = 0.0;
  drift_world_.setZero();
}

void DriftObserver::update(const VesselState& state, double sway_force, double dt_s) {
  const Eigen::Vector2d bow(std::cos(state.heading), std::sin(state.heading));
  const Eigen::Vector2d left(-bow.y(), bow.x());
  const double surge = state.u - bow.dot(drift_world_);
  const double drag = model_.linear_damping[1] + model_.quadratic_damping[1] * std::abs(sway_);
  // The drag by the backward rule, which holds at any step.
  const double push = sway_force - model_.mass[0] * surge * state.r;
  sway_ = (sway_ + dt_s * push / model_.mass[1]) / (1.0 + dt_s * drag / model_.mass[1]);
  const double part = std::min(1.0, dt_s / time_constant_);
  drift_world_ += part * (state.v - sway_ - left.dot(drift_world_)) * left;
}

}  // namespace trident::control
