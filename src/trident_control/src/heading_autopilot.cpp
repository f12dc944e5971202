// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/heading_autopilot.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::control {
namespace {

/// A vessel that is turned by more than it can is not asked for more than this lead [rad].
constexpr double kLargestLead = 0.8;

}  // namespace

HeadingAutopilot::HeadingAutopilot(const HeadingParams& params, const VesselModel& model)
    : params_(params), model_(model) {}

void HeadingAutopilot::reset(const VesselState& state) {
  heading_ = state.heading;
  rate_ = std::clamp(state.r, -params_.max_rate, params_.max_rate);
  acceleration_ = 0.0;
  dt_s_ = 0.0;
  integral_.reset();
}

double HeadingAutopilot::hold(const VesselState& state, double target, double dt_s) {
  // Third-order reference model with its poles at -w, (s + w)^3; acceleration and rate saturate, so
  // that the reference stays one which the vessel can follow.
  const double w = params_.reference_frequency, limit = params_.max_acceleration;
  const double jerk = w * w * w * angle_difference(target, heading_) - 3.0 * w * w * rate_ -
                      3.0 * w * acceleration_;
  acceleration_ = std::clamp(acceleration_ + jerk * dt_s, -limit, limit);
  rate_ = std::clamp(rate_ + acceleration_ * dt_s, -params_.max_rate, params_.max_rate);
  heading_ = wrap_to_pi(heading_ + rate_ * dt_s);
  return follow(state, dt_s);
}

double HeadingAutopilot::turn(const VesselState& state, double rate, double dt_s) {
  const double wanted = std::clamp(rate, -params_.max_rate, params_.max_rate);
  const double limit = params_.max_acceleration;
  acceleration_ = std::clamp((wanted - rate_) * 3.0 * params_.reference_frequency, -limit, limit);
  rate_ += acceleration_ * dt_s;
  heading_ = wrap_to_pi(heading_ + rate_ * dt_s);
  // The reference must not run away from a vessel that cannot turn as fast as it was commanded.
  const double lead = angle_difference(heading_, state.heading);
  heading_ = wrap_to_pi(state.heading + std::clamp(lead, -kLargestLead, kLargestLead));
  return follow(state, dt_s);
}

double HeadingAutopilot::follow(const VesselState& state, double dt_s) {
  const double w = params_.natural_frequency;
  error_ = angle_difference(heading_, state.heading);
  dt_s_ = dt_s;
  // PD by pole placement at natural frequency and damping ratio, on the error from the reference;
  // what the reference itself needs, inertia and drag at its rate, is fed forward.
  asked_ = model_.mass[2] * (acceleration_ + 2.0 * params_.damping_ratio * w * (rate_ - state.r) +
                             w * w * error_) +
           model_.drag(2, rate_) + integral_.value();
  return asked_;
}

void HeadingAutopilot::settle(double given) {
  if (params_.integral_time <= 0.0) return;
  const double w = params_.natural_frequency;
  // K_i = K_p / T_i. The integral gets what the actuators
  // gave, so that it does not wind up while they saturate.
  const double gain = model_.mass[2] * w * w / params_.integral_time;
  integral_.add(gain * error_, dt_s_, asked_ - given, 0.02 * std::abs(asked_) + 1e-9);
}

}  // namespace trident::control
