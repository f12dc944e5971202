// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <string>

#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// What the robot can do. Infinite where nothing limits it.
struct MotionLimits {
  double vx_max = 0.0;     ///< [m/s]
  double vx_min = 0.0;     ///< Negative: it can drive backwards [m/s].
  double vy_max = 0.0;     ///< 0: it cannot move sideways [m/s].
  double wz_max = 0.0;     ///< [rad/s]
  double ax_max = 0.0;     ///< [m/s^2]
  double decel_max = 0.0;  ///< Of braking along x [m/s^2].
  double ay_max = 0.0;  ///< Of turns, too, where it cannot move sideways; 0: no limit then [m/s^2].
  double alpha_max = 0.0;           ///< [rad/s^2]
  double min_turning_radius = 0.0;  ///< 0: it turns on the spot [m].
};

/// Why a plan or a command could not be found. Numbers of Nav2's ComputePathToPose and FollowPath
/// where those have one.
enum class Failure {
  kNone,
  kCanceled,
  kStartOutside,
  kGoalOutside,
  kStartOccupied,
  kGoalOccupied,
  kNoPath,
  kTimeout,
  kStaleSensor,
  kBlocked,  ///< No admissible command is free of contact.
  kNoProgress,
  kInvalidPath,
  kInvalidInput,
};

/// A flag that another thread sets to end a computation early; it is polled at least every 10 ms.
using CancelFlag = std::atomic<bool>;

/// A path or the reason for its absence.
struct PlanOutcome {
  Path path;
  Failure failure = Failure::kNone;
  std::string reason;  ///< Whole sentence for the user: where, what, which limit; may also comment
                       ///< on a success.
  double cost = 0.0;   ///< Of the path, in the planner's own units.
};

/// A command or the reason for its absence; `twist` is then the hardest admissible braking.
struct CommandOutcome {
  Twist2 twist;
  Failure failure = Failure::kNone;
  std::string reason;
  bool goal_reached = false;
};

}  // namespace trident::nav
