// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/config_types.h"
#include "trident_nav/control/robot_state.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// When a robot is where it was sent. Names and defaults of Nav2's goal checkers.
struct GoalTolerance {
  double xy_goal_tolerance = 0.25;
  double yaw_goal_tolerance = 0.25;
  bool stateful = true;
  double trans_stopped_velocity = 0.25;
  double rot_stopped_velocity = 0.25;
  /// Where the robot cannot get nearer for `fallback_time`, this many times both tolerances do.
  double fallback_factor = 2.0;
  double fallback_time = 5.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("xy_goal_tolerance", xy_goal_tolerance, Range::positive(), "of the position [m]");
    ar.field("yaw_goal_tolerance", yaw_goal_tolerance, Range::positive(), "of the heading [rad]");
    ar.field("stateful", stateful, "a position once reached stays so while the robot turns");
    ar.field("trans_stopped_velocity", trans_stopped_velocity, Range::positive(),
             "a slower robot stands [m/s]");
    ar.field("rot_stopped_velocity", rot_stopped_velocity, Range::positive(),
             "a slower turn counts as standing [rad/s]");
    ar.field("fallback_factor", fallback_factor, Range::at_least(1.0),
             "on both tolerances where the robot gets no nearer");
    ar.field("fallback_time", fallback_time, Range::positive(), "without getting nearer [s]");
  }
};

enum class ArrivalPhase {
  kApproach,  ///< Drive to the position.
  kTurn,      ///< The position is reached; turn to the heading.
  kReached,   ///< Position and heading are within tolerance, and the robot stands.
};

/// Judges position and heading together, with hysteresis: the turn begins well within the tolerance
/// of the position, or where the robot gets no nearer within it, and ends as a new approach only
/// once that tolerance is left. What cannot turn on the spot is done well within both tolerances,
/// or where neither error falls within them: tolerances are of the true errors, and what the robot
/// knows of its pose is off by some centimeters.
class GoalArrival {
 public:
  /// `can_turn`: the robot can turn on the spot.
  GoalArrival(const GoalTolerance& tolerance, bool can_turn)
      : tolerance_(tolerance), can_turn_(can_turn) {}

  ArrivalPhase update(const RobotState& state, const Pose2& goal);
  void reset() { *this = GoalArrival(tolerance_, can_turn_); }

  const GoalTolerance& tolerance() const { return tolerance_; }

 private:
  /// From the goal's pose.
  struct GoalErrors {
    double distance_m = 0.0, yaw_rad = 0.0;
  };

  void take(const Pose2& goal, double time_s, const GoalErrors& errors);
  void change_phase(double time_s, const GoalErrors& errors, bool is_at_position);
  bool has_arrived(double time_s, const GoalErrors& errors) const;
  bool is_stopped(const Twist2& twist) const;
  bool is_within(const GoalErrors& errors, double part) const;
  bool starts_turn(double time_s, double distance_m) const;
  bool has_settled(double time_s, const GoalErrors& errors) const;
  void note_progress(double time_s, const GoalErrors& errors);

  GoalTolerance tolerance_;
  bool can_turn_;
  ArrivalPhase phase_ = ArrivalPhase::kApproach;
  Pose2 goal_;
  bool has_goal_ = false;
  GoalErrors least_;       ///< The least distance so far, and the least heading since then.
  double nearer_s_ = 0.0;  ///< When the distance last fell.
  double better_s_ = 0.0;  ///< When either last fell.
};

}  // namespace trident::nav
