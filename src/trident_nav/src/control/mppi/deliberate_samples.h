// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "control_plan.h"
#include "critics/critic.h"

namespace trident::nav {

/// Where the robot has been, newest last, in the costmap's frame.
class Trail {
 public:
  explicit Trail(double length_m) : length_m_(length_m) {}

  /// Poses nearer to the last one than `spacing_m` are left out.
  void add(const Pose2& pose, double spacing_m);
  void clear() { poses_.clear(); }
  /// From the newest to the oldest, relative to a pose's position.
  std::vector<Point2> backwards_from(const Pose2& pose) const;

 private:
  double length_m_;
  std::vector<Pose2> poses_;
};

/// Follows points at a speed (negative: backwards) by pure pursuit, within the model's limits, and
/// turns on the spot first where they lead off to the side and the robot can.
ControlPlan pursue(const MppiModel& model, const std::vector<Point2>& points,
                   const RolloutStart& start, double speed, double lookahead_m);

/// Plans that noise would find late or not at all, for the lanes of one block: the last one, a
/// stop, turns on the spot in both directions, back along the own trail, along the path at several
/// speeds and lookaheads, and arcs.
void write_deliberate_samples(const MppiModel& model, const CriticScene& scene,
                              const RolloutStart& start, const ControlPlan& last_plan,
                              const Trail& trail, Rollouts* rollouts);

}  // namespace trident::nav
