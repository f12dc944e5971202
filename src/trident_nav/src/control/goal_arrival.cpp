// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/control/goal_arrival.h"

#include <cmath>

namespace trident::nav {
namespace {

// Of the tolerances: within that part of them a turn begins, or the drive ends, at once.
constexpr double kInner = 0.5;
constexpr double kSettled_s = 0.5;  // without progress
// A distance that shrinks by less is no progress [m].
constexpr double kProgress = 1e-3;
constexpr double kTurned = 0.01;  // [rad]

// A goal that a correction of the robot's position shifts stays the same one.
bool is_same(const Pose2& a, const Pose2& b, const GoalTolerance& tolerance) {
  return distance(a.x, a.y, b.x, b.y) <= tolerance.xy_goal_tolerance &&
         std::fabs(wrap_angle(a.yaw - b.yaw)) <= tolerance.yaw_goal_tolerance;
}

}  // namespace

bool GoalArrival::is_stopped(const Twist2& twist) const {
  return std::hypot(twist.vx, twist.vy) <= tolerance_.trans_stopped_velocity &&
         std::fabs(twist.wz) <= tolerance_.rot_stopped_velocity;
}

void GoalArrival::note_progress(double time_s, const GoalErrors& errors) {
  if (errors.distance_m < least_.distance_m - kProgress) {
    least_ = errors;
    nearer_s_ = better_s_ = time_s;
  }
  // Next to the goal a robot that shuttles comes no nearer, but turns.
  if (errors.yaw_rad < least_.yaw_rad - kTurned) {
    least_.yaw_rad = errors.yaw_rad;
    better_s_ = time_s;
  }
}

bool GoalArrival::is_within(const GoalErrors& errors, double part) const {
  return errors.distance_m <= part * tolerance_.xy_goal_tolerance &&
         errors.yaw_rad <= part * tolerance_.yaw_goal_tolerance;
}

bool GoalArrival::starts_turn(double time_s, double distance_m) const {
  if (distance_m <= kInner * tolerance_.xy_goal_tolerance) return true;
  return distance_m <= tolerance_.xy_goal_tolerance && time_s - nearer_s_ >= kSettled_s;
}

bool GoalArrival::has_settled(double time_s, const GoalErrors& errors) const {
  return is_within(errors, kInner) || (is_within(errors, 1.0) && time_s - better_s_ >= kSettled_s);
}

/// Takes a goal, which begins an approach unless it is the one at present.
void GoalArrival::take(const Pose2& goal, double time_s, const GoalErrors& errors) {
  const bool is_new = !has_goal_ || !is_same(goal, goal_, tolerance_);
  goal_ = goal;
  if (!is_new) return;
  has_goal_ = true;
  phase_ = ArrivalPhase::kApproach;
  least_ = errors;
  nearer_s_ = better_s_ = time_s;
}

void GoalArrival::change_phase(double time_s, const GoalErrors& errors, bool is_at_position) {
  if (can_turn_ && phase_ == ArrivalPhase::kApproach && starts_turn(time_s, errors.distance_m)) {
    phase_ = ArrivalPhase::kTurn;
  }
  if (phase_ == ArrivalPhase::kTurn && !is_at_position) phase_ = ArrivalPhase::kApproach;
}

bool GoalArrival::has_arrived(double time_s, const GoalErrors& errors) const {
  if (!can_turn_) return has_settled(time_s, errors);
  return phase_ == ArrivalPhase::kTurn && errors.yaw_rad <= tolerance_.yaw_goal_tolerance;
}

ArrivalPhase GoalArrival::update(const RobotState& state, const Pose2& goal) {
  const GoalErrors errors{distance(state.pose.x, state.pose.y, goal.x, goal.y),
                          std::fabs(wrap_angle(goal.yaw - state.pose.yaw))};
  take(goal, state.time_s, errors);
  note_progress(state.time_s, errors);
  const bool is_fallback = state.time_s - better_s_ >= tolerance_.fallback_time &&
                           is_within(errors, tolerance_.fallback_factor);
  const bool is_at_position = errors.distance_m <= tolerance_.xy_goal_tolerance || is_fallback;
  change_phase(state.time_s, errors, is_at_position);
  const bool is_there = is_fallback || has_arrived(state.time_s, errors);
  return is_there && is_stopped(state.twist) ? ArrivalPhase::kReached : phase_;
}

}  // namespace trident::nav
