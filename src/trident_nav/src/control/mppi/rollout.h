// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lanes.h"
#include "mppi_model.h"

namespace trident::nav {

/// kLanes trajectories: for each step after its end, lane by lane. Positions are relative to where
/// the robot is, in the costmap's axes [m]; velocities in the base's axes.
struct Rollouts {
  int steps = 0;
  std::vector<float> vx, vy, wz;    ///< In: what is wanted. Out: what the limits allow.
  std::vector<float> x, y;          ///< [m]
  std::vector<float> cosine, sine;  ///< Of the heading.
  std::vector<float> yaw;           ///< Not wrapped [rad].
  std::vector<float> clearance;     ///< From the footprint's cover to obstacles [m].
  std::vector<int> contact_step;    ///< First step in contact of each lane; steps: none.

  explicit Rollouts(int steps_);
  float* at(std::vector<float>& values, int step) { return values.data() + step * kLanes; }
  const float* at(const std::vector<float>& values, int step) const {
    return values.data() + step * kLanes;
  }
};

/// Where trajectories begin.
struct RolloutStart {
  double yaw = 0.0;
  Twist2 twist;
};

/// Holds the limits and the accelerations in what is wanted, and integrates. Of a vessel, what its
/// thrusters, its drag and the current make of it: velocities over ground.
void roll_out(const MppiModel& model, const RolloutStart& start, Rollouts* rollouts);

}  // namespace trident::nav
