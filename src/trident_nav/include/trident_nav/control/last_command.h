// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_nav/control/motion.h"
#include "trident_nav/control/robot_state.h"

namespace trident::nav {

/// The newest command of a base, and so how it is about to move. Odometry reports the past: a
/// window about the measured velocity alone lets a command grow once per delay of the base instead
/// of once per period, and never from a standstill that friction holds.
class LastCommand {
 public:
  /// `period_s`: between commands.
  LastCommand(const MotionLimits& limits, double period_s) : limits_(limits), period_s_(period_s) {}

  void note(const Twist2& twist, double time_s);
  void forget() { is_known_ = false; }
  /// Zero without one.
  Twist2 newest() const { return is_known_ ? twist_ : Twist2{}; }

  /// The command of the period before, as far as the base can have come to it from the measured
  /// velocity within a delay of `kMaxDelay_s`; without one, the measured velocity.
  Twist2 motion(const RobotState& measured) const;

  static constexpr double kMaxDelay_s = 0.25;  ///< Of a base and its odometry together.

 private:
  MotionLimits limits_;
  double period_s_;
  Twist2 twist_;
  double time_s_ = 0.0;
  bool is_known_ = false;
};

}  // namespace trident::nav
