// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/vehicle/thruster_curve.h"

#include <algorithm>
#include <cmath>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident {
namespace {

/// Generalized logistic function between the asymptotes
/// A and K; thrust in [N] of a command in [-1, 1].
struct Glf {
  double A, K, B, nu, C, M;
  double operator()(double x) const {
    return A + (K - A) / std::pow(C + std::exp(-B * (x - M)), 1.0 / nu);
  }
  /// The x of a value that the curve takes.
  double inverse(double thrust) const {
    return M - std::log(std::pow((K - A) / (thrust - A), nu) - C) / B;
  }
};

/// VRX' branches ahead and astern do not join at zero, hence the dead band between them.
constexpr Glf kForward{0.01, 59.82, 5.0, 0.38, 0.56, 0.28};
constexpr Glf kReverse{-199.13, -0.09, 8.84, 5.34, 0.99, -0.57};
/// VRX' curve gives nothing up to here; the first command beyond.
constexpr double kGlfDeadBand = 0.01, kGlfFirst = 0.01 + 1e-9;

double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (at <= x.front()) return y.front();
  if (at >= x.back()) return y.back();
  const auto next = std::upper_bound(x.begin(), x.end(), at);
  const auto i = static_cast<std::size_t>(next - x.begin());
  const double part = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return y[i - 1] + part * (y[i] - y[i - 1]);
}

/// The x nearest to 0 at which a table that does not fall takes `value`, which is within it.
double inverse_interpolated(const std::vector<double>& x, const std::vector<double>& y,
                            double value) {
  double best = x.back();
  for (std::size_t i = x.size() - 1; i > 0; --i) {
    if (value < y[i - 1] || value > y[i]) continue;
    const bool is_flat = y[i] == y[i - 1];
    const double at = is_flat
                          ? std::clamp(0.0, x[i - 1], x[i])
                          : x[i - 1] + (value - y[i - 1]) / (y[i] - y[i - 1]) * (x[i] - x[i - 1]);
    if (std::abs(at) <= std::abs(best)) best = at;
  }
  return best;
}

[[noreturn]] void refuse(const ThrusterParams& params, const std::string& problem) {
  throw Error("thruster '" + params.name + "': " + problem);
}

void check_coefficients(const ThrusterParams& params) {
  if (params.coefficient_forward > 0.0 && params.coefficient_reverse > 0.0) return;
  refuse(params, "mapping quadratic needs coefficient_forward = " +
                     number_text(params.coefficient_forward) + " and coefficient_reverse = " +
                     number_text(params.coefficient_reverse) + ", legal is > 0");
}

void check_table(const ThrusterParams& params) {
  const std::vector<double>& commands = params.table_commands;
  if (commands.size() != params.table_forces.size() || commands.size() < 2) {
    refuse(params, "table_commands has " + std::to_string(commands.size()) +
                       " numbers, table_forces " + std::to_string(params.table_forces.size()) +
                       ", legal is the same number of both, at least 2");
  }
  for (std::size_t i = 1; i < commands.size(); ++i) {
    if (commands[i] <= commands[i - 1]) {
      refuse(params, "table_commands[" + std::to_string(i) + "] = " + number_text(commands[i]) +
                         " must be above the one before, " + number_text(commands[i - 1]));
    }
  }
}

double linear_state_for(const ThrusterParams& params, double thrust_n) {
  return thrust_n > 0.0 ? thrust_n / params.max_force_forward * params.max_command
                        : thrust_n / params.max_force_reverse * -params.min_command;
}

/// The curve jumps at its dead band: what is less than the jump takes the first command beyond it.
double glf_state_for(double thrust_n) {
  const double first = thrust_n > 0.0 ? kGlfFirst : -kGlfFirst;
  if (std::abs(thrust_n) <= std::abs(vrx_glf_thrust(first))) return first;
  return (thrust_n > 0.0 ? kForward : kReverse).inverse(thrust_n);
}

/// Of F = k n |n|, with a coefficient k for each sense of rotation.
double quadratic_state_for(const ThrusterParams& params, double thrust_n) {
  return thrust_n > 0.0 ? std::sqrt(thrust_n / params.coefficient_forward)
                        : -std::sqrt(-thrust_n / params.coefficient_reverse);
}

/// The state of a thrust that the curve takes between its ends, the dead band left out.
double state_for(const ThrusterParams& params, double thrust_n) {
  if (thrust_n == 0.0) return 0.0;
  switch (params.mapping) {
    case ThrustMapping::kLinear:
      return linear_state_for(params, thrust_n);
    case ThrustMapping::kGlf:
      return glf_state_for(thrust_n);
    case ThrustMapping::kQuadratic:
      return quadratic_state_for(params, thrust_n);
    case ThrustMapping::kTable:
      return inverse_interpolated(params.table_commands, params.table_forces, thrust_n);
  }
  return 0.0;
}

}  // namespace

void ThrusterParams::validate() const {
  if (mapping == ThrustMapping::kQuadratic) check_coefficients(*this);
  if (mapping == ThrustMapping::kTable) check_table(*this);
}

double vrx_glf_thrust(double command) {
  if (command > kGlfDeadBand) return kForward(std::min(command, 1.0));
  if (command < -kGlfDeadBand) return kReverse(std::max(command, -1.0));
  return 0.0;
}

double thrust_at(const ThrusterParams& params, double state) {
  double thrust = 0.0;
  switch (params.mapping) {
    case ThrustMapping::kLinear:
      thrust = state >= 0.0 ? state / params.max_command * params.max_force_forward
                            : state / -params.min_command * params.max_force_reverse;
      break;
    case ThrustMapping::kGlf:
      thrust = vrx_glf_thrust(state);
      break;
    case ThrustMapping::kQuadratic:
      thrust = (state >= 0.0 ? params.coefficient_forward : params.coefficient_reverse) * state *
               std::abs(state);
      break;
    case ThrustMapping::kTable:
      thrust = interpolated(params.table_commands, params.table_forces, state);
      break;
  }
  // Curves are measured with a certain propeller; the limits are this thruster's.
  return std::clamp(thrust, -params.max_force_reverse, params.max_force_forward);
}

double command_for(const ThrusterParams& params, double thrust_n) {
  const double least = params.min_command < 0.0 ? thrust_at(params, params.min_command) : 0.0;
  const double most = thrust_at(params, params.max_command);
  // A curve that has no thrust of this sign is asked for zero.
  const double wanted = std::clamp(thrust_n, std::min(least, 0.0), std::max(most, 0.0));
  const double state =
      std::clamp(state_for(params, wanted), params.min_command, params.max_command);
  // A step at the edge of the dead band: nothing, or what the edge gives, whichever is nearer.
  const double edge = std::copysign(params.dead_band, state);
  const double command = std::abs(state) < params.dead_band ? edge : state;
  return std::abs(thrust_at(params, command) - wanted) < std::abs(wanted) ? command : 0.0;
}

void check_invertible(const ThrusterParams& params) {
  if (params.mapping != ThrustMapping::kTable) return;
  for (std::size_t i = 1; i < params.table_forces.size(); ++i) {
    if (params.table_forces[i] < params.table_forces[i - 1]) {
      refuse(params, "table_forces[" + std::to_string(i) +
                         "] = " + number_text(params.table_forces[i]) +
                         " falls below the one before, " + number_text(params.table_forces[i - 1]) +
                         "; legal, to be controlled, is a table that does not fall");
    }
  }
}

}  // namespace trident
