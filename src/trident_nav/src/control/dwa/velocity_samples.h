// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_nav/control/motion.h"

namespace trident::nav {

/// How many velocities of each axis are tried, and which are allowed. 0 speeds without a limit.
struct VelocitySampling {
  int vx_samples = 20;
  int vy_samples = 1;
  int vth_samples = 20;
  double min_speed = 0.0;      ///< Of a moving robot, with min_turn_rate [m/s].
  double max_speed = 0.0;      ///< In the plane; 0: no limit [m/s].
  double min_turn_rate = 0.0;  ///< Of a turn on the spot [rad/s].
};

/// The products of evenly spaced velocities between the window's ends, and zero where that is
/// between them; without those that are too slow or too fast.
std::vector<Twist2> sample_velocities(const TwistWindow& window, const VelocitySampling& sampling);
/// The same, behind what `samples` has.
void append_velocities(const TwistWindow& window, const VelocitySampling& sampling,
                       std::vector<Twist2>* samples);

}  // namespace trident::nav
