// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/surge_speed_controller.h"

#include <algorithm>
#include <cmath>

namespace trident::control {

SurgeSpeedController::SurgeSpeedController(const SpeedParams& params, const VesselModel& model)
    : params_(params), model_(model) {}

void SurgeSpeedController::reset(double speed) {
  speed_ = std::clamp(speed, -params_.max_reverse, params_.max);
  dt_s_ = 0.0;
  integral_.reset();
}

double SurgeSpeedController::hold(std::optional<double> measured, double target, double dt_s) {
  const double wanted = std::clamp(target, -params_.max_reverse, params_.max);
  const double limit = params_.max_acceleration;
  const double acceleration =
      std::clamp(2.0 * (wanted - speed_) / params_.time_constant, -limit, limit);
  speed_ += acceleration * dt_s;
  error_ = measured ? speed_ - *measured : 0.0;
  dt_s_ = dt_s;
  if (!measured) integral_.reset();
  asked_ = model_.mass[0] * (acceleration + error_ / params_.time_constant) +
           model_.drag(0, speed_) + integral_.value();
  return asked_;
}

void SurgeSpeedController::settle(double given) {
  if (params_.integral_time <= 0.0) return;
  // What resists a wrong speed is the drag, too: the integral settles in its own time, slower than
  // both.
  const double resistance = model_.mass[0] / params_.time_constant + model_.linear_damping[0];
  const double gain = resistance / params_.integral_time;
  integral_.add(gain * error_, dt_s_, asked_ - given, 0.02 * std::abs(asked_) + 1e-9);
}

}  // namespace trident::control
