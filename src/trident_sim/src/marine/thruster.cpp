// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "thruster.h"

#include <algorithm>
#include <cmath>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident {
namespace {

struct Glf {
  double A, K, B, nu, C, M;
  double operator()(double x) const {
    return A + (K - A) / std::pow(C + std::exp(-B * (x - M)), 1.0 / nu);
  }
};

double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (at <= x.front()) return y.front();
  if (at >= x.back()) return y.back();
  const auto next = std::upper_bound(x.begin(), x.end(), at);
  const auto i = static_cast<std::size_t>(next - x.begin());
  const double part = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return y[i - 1] + part * (y[i] - y[i - 1]);
}

std::string range_text(double lo, double hi) {
  return "[" + number_text(lo) + ", " + number_text(hi) + "]";
}

[[noreturn]] void refuse(const ThrusterParams& params, const std::string& problem) {
  throw Error("thruster '" + params.name + "': " + problem);
}

}  // namespace

void ThrusterParams::validate() const {
  if (mapping == ThrustMapping::kQuadratic &&
      !(coefficient_forward > 0.0 && coefficient_reverse > 0.0)) {
    refuse(*this,
           "mapping quadratic needs coefficient_forward = " + number_text(coefficient_forward) +
               " and coefficient_reverse = " + number_text(coefficient_reverse) + ", legal is > 0");
  }
  if (mapping != ThrustMapping::kTable) return;
  if (table_commands.size() != table_forces.size() || table_commands.size() < 2) {
    refuse(*this, "table_commands has " + std::to_string(table_commands.size()) +
                      " numbers, table_forces " + std::to_string(table_forces.size()) +
                      ", legal is the same number of both, at least 2");
  }
  for (std::size_t i = 1; i < table_commands.size(); ++i) {
    if (table_commands[i] <= table_commands[i - 1]) {
      refuse(*this, "table_commands[" + std::to_string(i) +
                        "] = " + number_text(table_commands[i]) +
                        " must be above the one before, " + number_text(table_commands[i - 1]));
    }
  }
}

double vrx_glf_thrust(double command) {
  static constexpr Glf kForward{0.01, 59.82, 5.0, 0.38, 0.56, 0.28};
  static constexpr Glf kReverse{-199.13, -0.09, 8.84, 5.34, 0.99, -0.57};
  if (command > 0.01) return kForward(std::min(command, 1.0));
  if (command < -0.01) return kReverse(std::max(command, -1.0));
  return 0.0;
}

Thruster::Thruster(const ThrusterParams& params) : params_(params) { params_.validate(); }

std::string Thruster::check_command(double command) const {
  if (command >= params_.min_command && command <= params_.max_command) return "";
  return "thruster '" + params_.name + "': command = " + number_text(command) + ", legal is " +
         range_text(params_.min_command, params_.max_command);
}

void Thruster::command(double value) {
  if (!std::isfinite(value)) throw Error(check_command(value));
  command_ = std::clamp(value, params_.min_command, params_.max_command);
}

void Thruster::command_angle(double angle_rad) {
  if (!std::isfinite(angle_rad)) {
    refuse(params_, "angle = " + number_text(angle_rad) + " rad, legal is " +
                        range_text(-params_.max_angle, params_.max_angle));
  }
  command_angle_rad_ = std::clamp(angle_rad, -params_.max_angle, params_.max_angle);
}

void Thruster::step(double dt_s) {
  const double wanted = std::abs(command_) < params_.dead_band ? 0.0 : command_;
  // Exact for a command that is constant over the step.
  const double decay = params_.time_constant > 0.0 ? std::exp(-dt_s / params_.time_constant) : 0.0;
  state_ = wanted + decay * (state_ - wanted);
  const double turn = params_.angle_rate * dt_s;
  angle_rad_ += std::clamp(command_angle_rad_ - angle_rad_, -turn, turn);
}

void Thruster::reset() { command_ = state_ = command_angle_rad_ = angle_rad_ = 0.0; }

double Thruster::thrust_at(double state) const {
  double thrust = 0.0;
  switch (params_.mapping) {
    case ThrustMapping::kLinear:
      thrust = state >= 0.0 ? state / params_.max_command * params_.max_force_forward
                            : state / -params_.min_command * params_.max_force_reverse;
      break;
    case ThrustMapping::kGlf:
      thrust = vrx_glf_thrust(state);
      break;
    case ThrustMapping::kQuadratic:
      thrust = (state >= 0.0 ? params_.coefficient_forward : params_.coefficient_reverse) * state *
               std::abs(state);
      break;
    case ThrustMapping::kTable:
      thrust = interpolated(params_.table_commands, params_.table_forces, state);
      break;
  }
  return std::clamp(thrust, -params_.max_force_reverse, params_.max_force_forward);
}

double Thruster::thrust_n() const { return thrust_at(state_); }

Vector6d Thruster::wrench() const {
  const double direction = params_.yaw + angle_rad_;
  const Eigen::Vector3d force =
      thrust_n() * Eigen::Vector3d(std::cos(direction), std::sin(direction), 0.0);
  Vector6d result;
  result << force, params_.position.cross(force);
  return result;
}

}  // namespace trident
