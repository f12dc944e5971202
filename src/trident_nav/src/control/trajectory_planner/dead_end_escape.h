// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "trident_nav/control/progress_monitor.h"
#include "trident_nav/control/robot_state.h"

namespace trident::nav {

/// When a robot that cannot drive forward has driven backwards far enough. One that comes to the
/// same dead end again drives back twice as far as before, so that it finds room to turn.
class DeadEndEscape {
 public:
  /// What ends the first escape from a dead end.
  struct Limits {
    double distance_m = 0.0;  ///< Driven; later escapes take multiples of it.
    double turn = 0.0;        ///< [rad]
    double leaving_m = 0.0;   ///< Farther away, a dead end is behind the robot.
  };
  explicit DeadEndEscape(const Limits& limits) : limits_(limits) {}

  void reset() { *this = DeadEndEscape(limits_); }
  /// Once per command: forgets what is over. Returns true where the robot has not moved for a
  /// second, whatever was commanded.
  bool update(const RobotState& state);
  /// Begins an escape, unless one has begun. `is_straight`: it is one that does not end by a
  /// turn.
  void begin(const RobotState& state, bool is_straight = false);
  /// Ends the escape: there is no room behind.
  void end() { from_.reset(); }

  bool is_active() const { return from_.has_value(); }
  /// Nothing but backwards will do.
  bool is_straight() const { return from_.has_value() && count_ > 1; }
  bool is_near_dead_end() const { return dead_end_.has_value(); }

 private:
  double distance_m() const;
  bool is_over(const Pose2& pose) const;   ///< The escape.
  bool has_left(const Pose2& pose) const;  ///< The dead end.

  Limits limits_;
  std::optional<Pose2> from_;      // where the escape began
  std::optional<Pose2> dead_end_;  // where the first one began, until that is left
  int count_ = 0;                  // escapes from this dead end
  // Moves of less than 0.02 m and 0.05 rad within a second are noise; used up after a whole second.
  ProgressMonitor standstill_{{0.02, 0.05, 1.0 - 1e-9}};
};

}  // namespace trident::nav
