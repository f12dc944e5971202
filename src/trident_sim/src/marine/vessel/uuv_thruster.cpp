// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "uuv_thruster.h"

#include <cmath>

namespace trident::sim {
namespace {

/// One step of s_dot = drive - linear s - quadratic s|s|.
double dragged(double state, double drive, double linear, double quadratic, double dt_s) {
  return (state + dt_s * drive) / (1.0 + dt_s * (linear + quadratic * std::abs(state)));
}

/// Linear between the points (x rises), constant beyond them.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (at <= x.front()) return y.front();
  std::size_t i = 1;
  while (i < x.size() && x[i] < at) ++i;
  if (i == x.size()) return y.back();
  return y[i - 1] + (at - x[i - 1]) / (x[i] - x[i - 1]) * (y[i] - y[i - 1]);
}

}  // namespace

void UuvThruster::step(double input, double dt_s) {
  const UuvThrusterParams& p = params_;
  switch (p.dynamics) {
    case UuvDynamics::kZeroOrder:
      state_ = input;
      break;
    case UuvDynamics::kFirstOrder:
      state_ = input + std::exp(-dt_s / p.time_constant_s) * (state_ - input);
      break;
    case UuvDynamics::kYoerger:
      state_ = dragged(state_, p.beta * input, 0.0, p.alpha, dt_s);
      break;
    case UuvDynamics::kBessa:
      state_ = dragged(state_, p.Kt * input / p.Rm / p.Jmsp, p.Kv1 / p.Jmsp, p.Kv2 / p.Jmsp, dt_s);
      break;
  }
}

double UuvThruster::thrust_at(double state) const {
  const UuvThrusterParams& p = params_;
  const double square = state * std::abs(state);
  switch (p.conversion) {
    case UuvConversion::kBasic:
      return p.rotor_constant * square;
    case UuvConversion::kBessa:
      if (square <= p.delta_left) return p.rotor_constant_left * (square - p.delta_left);
      if (square >= p.delta_right) return p.rotor_constant_right * (square - p.delta_right);
      return 0.0;
    case UuvConversion::kLinearInterp:
      return interpolated(p.inputs, p.outputs, state);
  }
  return 0.0;
}

}  // namespace trident::sim
