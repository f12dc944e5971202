// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/world/joint_drive.h"

#include <algorithm>
#include <cmath>

#include "trident_base/error.h"

namespace trident::sim {
namespace {

std::string name_of(const Joint& joint, std::size_t axis) {
  return "drive of joint '" + joint.spec.name + "' axis " + std::to_string(axis);
}

void check_axis(const Joint& joint, std::size_t axis) {
  if (joint.is_rotor) {
    throw Error(name_of(joint, axis) + ": the joint is a rotor that a motor model turns");
  }
  if (axis >= joint.axis_count()) {
    throw Error(name_of(joint, axis) + ": the joint has " + std::to_string(joint.axis_count()) +
                " axes");
  }
}

}  // namespace

void validate(const PidGains& gains, const std::string& what) {
  const std::pair<const char*, double> values[] = {{"p", gains.p}, {"i", gains.i}, {"d", gains.d}};
  for (const auto& [name, value] : values) {
    if (!std::isfinite(value)) {
      throw Error(what + ": gain " + name + " is " + std::to_string(value) + ", must be finite");
    }
  }
  const std::pair<const char*, double> limits[] = {{"integral_limit", gains.integral_limit},
                                                   {"output_limit", gains.output_limit}};
  for (const auto& [name, value] : limits) {
    if (!(value >= 0.0)) {
      throw Error(what + ": " + name + " is " + std::to_string(value) + ", must be >= 0");
    }
  }
}

double Pid::update(double error, double error_rate, double dt_s) {
  // The integral is kept as an effort: its clamp stops windup, and a change of gain makes no bump.
  integral_effort_ = std::clamp(integral_effort_ + gains_.i * error * dt_s, -gains_.integral_limit,
                                gains_.integral_limit);
  return std::clamp(gains_.p * error + integral_effort_ + gains_.d * error_rate,
                    -gains_.output_limit, gains_.output_limit);
}

JointDrive::JointDrive(Joint& joint, std::size_t axis, const DriveSpec& spec)
    : joint_(&joint), axis_(axis), spec_(spec), pid_(spec.gains), target_(spec.target) {
  check_axis(joint, axis);
  validate(spec.gains, name_of(joint, axis));
  set_target(spec.target);
}

void JointDrive::set_target(double target) {
  if (!std::isfinite(target)) {
    throw Error(name_of(*joint_, axis_) + ": target is " + std::to_string(target) +
                ", must be finite");
  }
  target_ = target;
}

/// Towards a position the d term damps the joint's own rate, so that a new target makes no kick;
/// towards a velocity it acts on the change of the error, of which the first step knows none.
double JointDrive::wanted_effort(double dt_s) {
  const double limit = spec_.gains.output_limit;
  if (spec_.mode == DriveMode::kEffort) return std::clamp(target_, -limit, limit);
  const double rate = joint_->velocity(axis_);
  if (spec_.mode == DriveMode::kPosition) {
    return pid_.update(target_ - joint_->position(axis_), -rate, dt_s);
  }
  const double error = target_ - rate;
  const double error_rate = has_error_ ? (error - last_error_) / dt_s : 0.0;
  last_error_ = error;
  has_error_ = true;
  return pid_.update(error, error_rate, dt_s);
}

void JointDrive::apply(double dt_s) {
  effort_ = wanted_effort(dt_s);
  joint_->add_effort(effort_, axis_);
}

void JointDrive::reset() {
  pid_.reset();
  target_ = spec_.target;
  effort_ = last_error_ = 0.0;
  has_error_ = false;
}

void JointDrive::state(StateArchive& archive) {
  pid_.state(archive);
  archive(target_, effort_, last_error_, has_error_);
}

}  // namespace trident::sim
