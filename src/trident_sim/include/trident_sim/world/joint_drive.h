// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <string>

#include "trident_sim/model.h"

namespace trident::sim {

/// Efforts are in N m for an angle, in N for a length.
struct PidGains {
  double p = 0.0;  ///< effort per error
  double i = 0.0;  ///< effort per error and second
  double d = 0.0;  ///< effort per rate of the error
  double integral_limit = std::numeric_limits<double>::infinity();  ///< of the i term's effort
  double output_limit = std::numeric_limits<double>::infinity();    ///< of the whole effort
};

/// Throws Error, beginning with `what`, when a gain is not finite or a limit is not >= 0.
void validate(const PidGains& gains, const std::string& what);

/// Proportional, integral and derivative control of one number. The integral is kept in units of
/// effort and clamped, so that a change of gain does not jump and a saturated drive does not wind
/// up.
class Pid {
 public:
  /// The gains are not checked here; see validate().
  explicit Pid(const PidGains& gains) : gains_(gains) {}
  const PidGains& gains() const { return gains_; }  ///< as given
  /// Returns the effort for an error that changes at `error_rate`, after `dt_s`.
  double update(double error, double error_rate, double dt_s);
  void reset() { integral_effort_ = 0.0; }  ///< forgets the integral
  /// Saves or restores the integral.
  void state(StateArchive& archive) { archive(integral_effort_); }

 private:
  PidGains gains_;
  double integral_effort_ = 0.0;
};

/// What the target of a drive is.
enum class DriveMode {
  kEffort,    ///< the target is the effort; no gains
  kVelocity,  ///< the target is a rate [rad/s] or [m/s]
  kPosition   ///< the target is a position [rad] or [m]; the d term works on the joint's own rate
};

/// How an axis is driven.
struct DriveSpec {
  DriveMode mode = DriveMode::kPosition;  ///< fixed for the drive's life
  PidGains gains;                         ///< of kEffort only output_limit counts
  double target = 0.0;                    ///< at first, and after a reset
};

/// Drives one axis of a joint towards a target. The world applies its drives in every step, after
/// the plugins that turn commands into forces and before physics, from the state at the beginning
/// of the step. The joint's own effort limit holds as well.
class JointDrive {
 public:
  /// Throws Error when the joint has no such axis or is a rotor, or when a value is out of range.
  JointDrive(Joint& joint, std::size_t axis, const DriveSpec& spec);

  const Joint& joint() const { return *joint_; }  ///< outlives the drive
  std::size_t axis() const { return axis_; }      ///< 0 or 1
  /// As given; its target is where reset() returns to.
  const DriveSpec& spec() const { return spec_; }
  double target() const { return target_; }  ///< effort, rate or position, by spec().mode
  /// Throws Error for a target that is not finite.
  void set_target(double target);
  double effort() const { return effort_; }  ///< asked for in the last step

  /// Computes the effort of a step and adds it to the axis. Called by World once per step.
  void apply(double dt_s);
  /// Back to the first target, without an integral or a last error.
  void reset();
  /// Saves or restores target, integral and last error.
  void state(StateArchive& archive);

 private:
  double wanted_effort(double dt_s);

  Joint* joint_;
  std::size_t axis_;
  DriveSpec spec_;
  Pid pid_;
  double target_;
  double effort_ = 0.0;
  double last_error_ = 0.0;
  bool has_error_ = false;
};

}  // namespace trident::sim
