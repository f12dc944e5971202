// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "trident_nav/control/robot_state.h"
#include "trident_nav/core/footprint_checker.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// A pose on a trajectory at which the robot is in contact.
struct ContactAhead {
  Pose2 pose;
  double after_s = 0.0;
  int track_id = -1;  ///< Of the moving obstacle; -1: a cell of the grid.
};

/// What is kept free around a footprint: what a base's controller and the commands' discrete times
/// make of a trajectory [m].
double guard_padding_m(const Footprint& footprint);

/// The last check of each command: with it for one period and the hardest braking after, the robot
/// stands before it touches anything. What passes is therefore safe for ever in a world that
/// stands still: the braking that was checked is always left.
class BrakingGuard {
 public:
  /// The checkers must outlive the guard; that of the padded footprint makes up for how a base
  /// follows commands. `period_s`: until the next command.
  BrakingGuard(const MotionLimits& limits, const FootprintChecker& checker,
               const FootprintChecker& padded_checker, double period_s);

  /// The first contact on the braking trajectory of a command; nothing if it is free. A robot
  /// that is in contact already, or within the padding, may do what leads no deeper.
  std::optional<ContactAhead> first_contact(const RobotState& state, const Twist2& command,
                                            const CostGrid& grid, const Tracks& tracks) const;

 private:
  int tightness(const CostGrid& grid, const Pose2& pose) const;
  std::optional<int> hit_track(const Pose2& pose, double after_s, const Twist2& twist,
                               const Tracks& tracks) const;
  bool is_hit(const Pose2& pose, double after_s, const Twist2& twist, const Track& track) const;
  double step_duration(const Pose2& pose, double speed, const CostGrid& grid) const;
  double advance(const Twist2& command, const CostGrid& grid, double t, Pose2* pose,
                 Twist2* twist) const;

  MotionLimits limits_;
  const FootprintChecker& checker_;
  const FootprintChecker& padded_checker_;
  double period_s_;
};

/// How many occupied cells have their centers in the footprint: how deep a contact is.
int occupied_cells_within(const Footprint& footprint, const CostGrid& grid, const Pose2& pose);

}  // namespace trident::nav
