// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_nav/core/geometry.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// The pose after `duration_s` at a constant twist, exactly.
Pose2 integrate(const Pose2& pose, const Twist2& twist, double duration_s);

/// The least and the greatest velocity of each axis that the robot can have.
struct TwistWindow {
  Twist2 lo, hi;

  Twist2 clamp(const Twist2& twist) const;
};

/// What can be reached from `twist` within `duration_s`, within the limits of speed; where the
/// robot is faster than those allow, the hardest braking alone. Braking acts as long as the speed
/// falls, acceleration where it grows.
TwistWindow reachable_window(const MotionLimits& limits, const Twist2& twist, double duration_s);

/// The twist nearest to the one wanted that is in the window and respects the least turning
/// radius. If the turn rate is what limits, the forward speed shrinks with it, so that the
/// curvature stays.
Twist2 admissible_twist(const MotionLimits& limits, const TwistWindow& window,
                        const Twist2& wanted);

/// What a turn may accelerate a robot sideways that cannot move sideways [m/s^2]: `ay_max`, as
/// wheels that hold along do not hold across for free; infinite where that is 0, and for robots
/// that can.
double turning_acceleration(const MotionLimits& limits);

/// The twist after `duration_s` of the hardest braking.
Twist2 braked(const MotionLimits& limits, const Twist2& twist, double duration_s);

/// The time the hardest braking takes [s]; nothing brakes sideways where `ay_max` is 0.
double braking_time(const MotionLimits& limits, const Twist2& twist);

/// The greatest speed from which a stop within `distance` is possible when braking sets in
/// `reaction_s` later [m, m/s^2 or rad, rad/s^2]. 0 for a distance that is not positive.
double stopping_speed(double distance, double deceleration, double reaction_s);

bool is_finite(const Pose2& pose);
bool is_finite(const Twist2& twist);

}  // namespace trident::nav
