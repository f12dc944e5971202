// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "thruster.h"

#include <algorithm>
#include <cmath>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

std::string range_text(double lo, double hi) {
  return "[" + number_text(lo) + ", " + number_text(hi) + "]";
}

[[noreturn]] void refuse(const ThrusterParams& params, const std::string& problem) {
  throw Error("thruster '" + params.name + "': " + problem);
}

}  // namespace

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
  // The angle is limited by its rate alone: a steering gear has no lag here.
  const double turn = params_.angle_rate * dt_s;
  angle_rad_ += std::clamp(command_angle_rad_ - angle_rad_, -turn, turn);
}

void Thruster::reset() { command_ = state_ = command_angle_rad_ = angle_rad_ = 0.0; }

double Thruster::thrust_n() const { return thrust_at(params_, state_); }

Vector6d Thruster::wrench() const {
  const double direction = params_.yaw + angle_rad_;
  const Eigen::Vector3d force =
      thrust_n() * Eigen::Vector3d(std::cos(direction), std::sin(direction), 0.0);
  Vector6d result;
  result << force, params_.position.cross(force);
  return result;
}

}  // namespace trident::sim
