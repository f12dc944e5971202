// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "velocity_samples.h"

#include <algorithm>
#include <cmath>

namespace trident::nav {
namespace {

std::vector<double> evenly(double lo, double hi, int count) {
  if (count <= 1 || hi - lo < 1e-9) return {std::clamp(0.0, lo, hi)};
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    const double value = lo + (hi - lo) * i / (count - 1);
    if (!values.empty() && values.back() < 0.0 && value > 0.0) values.push_back(0.0);
    values.push_back(value);
  }
  return values;
}

bool is_allowed(const Twist2& twist, const VelocitySampling& sampling) {
  constexpr double kRounding = 1e-4;
  const double speed = std::hypot(twist.vx, twist.vy);
  if (sampling.max_speed > 0.0 && speed > sampling.max_speed + kRounding) return false;
  const bool is_slow = speed + kRounding < sampling.min_speed;
  return !is_slow || std::fabs(twist.wz) + kRounding >= sampling.min_turn_rate;
}

}  // namespace

void append_velocities(const TwistWindow& window, const VelocitySampling& sampling,
                       std::vector<Twist2>* samples) {
  const auto all_vx = evenly(window.lo.vx, window.hi.vx, sampling.vx_samples);
  const auto all_vy = evenly(window.lo.vy, window.hi.vy, sampling.vy_samples);
  const auto all_wz = evenly(window.lo.wz, window.hi.wz, sampling.vth_samples);
  for (const double vx : all_vx) {
    for (const double vy : all_vy) {
      for (const double wz : all_wz) {
        const Twist2 twist{vx, vy, wz};
        if (is_allowed(twist, sampling)) samples->push_back(twist);
      }
    }
  }
}

std::vector<Twist2> sample_velocities(const TwistWindow& window, const VelocitySampling& sampling) {
  std::vector<Twist2> samples;
  append_velocities(window, sampling, &samples);
  return samples;
}

}  // namespace trident::nav
