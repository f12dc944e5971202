// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/wave_filter.h"

#include <cmath>

#include "trident_base/angle.h"

namespace trident::control {
namespace {

constexpr double kNotchDamping = 0.1;

}  // namespace

double WaveFilter::Notch::step(double x, double decay, double angle) {
  // Exact for an x that is constant over the step.
  second = x + decay * (second - x + angle * (first - x));
  first = x + decay * (first - x);
  return x - 2.0 * (1.0 - kNotchDamping) * (first - second);
}

/// Position, heading and velocities are filtered alike. The heading counts turns meanwhile, as a
/// filter would take a wrap for a motion.
VesselState WaveFilter::filter(const VesselState& state, double dt_s) {
  if (frequency_ <= 0.0) return state;
  if (!is_started_) heading_ = state.heading;
  heading_ += angle_difference(state.heading, heading_);
  std::array<double, 6> values{state.p_world.x(), state.p_world.y(), heading_,
                               state.u,           state.v,           state.r};
  const double angle = frequency_ * dt_s, decay = std::exp(-angle);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!is_started_) notches_[i] = {values[i], values[i]};
    values[i] = notches_[i].step(values[i], decay, angle);
  }
  is_started_ = true;
  VesselState filtered;
  filtered.p_world = {values[0], values[1]};
  filtered.heading = wrap_to_pi(values[2]);
  filtered.u = values[3], filtered.v = values[4], filtered.r = values[5];
  return filtered;
}

}  // namespace trident::control
