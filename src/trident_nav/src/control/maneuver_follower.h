// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>

#include "trident_nav/control/control_law.h"

namespace trident::nav {

/// Drives a base that cannot turn on the spot along the arcs of a maneuver: what a path has about
/// its changes of gear. These are followed as exactly as the base does, to the cusp, at a speed
/// that the room about the robot allows: where a slot leaves centimeters, nothing else leads on.
/// Feedback of the path's curvature, of the distance from it and of the heading's difference:
/// Samson, "Control of chained systems: application to path following and time-varying
/// point-stabilization of mobile robots", IEEE Trans. Automatic Control 40(1), 1995.
class ManeuverFollower {
 public:
  explicit ManeuverFollower(const ControlSetup& setup);

  /// Whether a base like this has maneuvers at all: it turns in circles, and drives backwards, too.
  static bool is_needed(const ControlSetup& setup);

  /// What to send; nothing where no change of gear is near, or the robot is too far off its path.
  std::optional<Twist2> follow(const Situation& situation);
  void reset();

 private:
  bool is_near_cusp(const LocalPath& path) const;
  void note_motion(const Situation& situation, int gear);
  double speed(const Situation& situation) const;
  std::optional<double> curvature_to(const Situation& situation, double v) const;
  bool is_steering(const Situation& situation, double steering);

  ControlSetup setup_;
  double reach_m_;  ///< From a change of gear.
  int gear_ = 0;    ///< 1: forwards, -1: backwards, 0: not known yet.
  double driven_m_ = std::numeric_limits<double>::infinity();  ///< Since the last change of gear.
  std::optional<Pose2> last_pose_;
  double steering_ = 0.0;    ///< Sent last: the turn rate by the speed [1/m].
  double steered_s_ = -1.0;  ///< When the wheels that steer have come to it [s].
};

}  // namespace trident::nav
