// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/control/goal_arrival.h"

#include <cmath>

namespace trident::nav {
namespace {

// Of the tolerance of the position: within it a turn begins at once.
constexpr double kInner = 0.5;
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

bool GoalArrival::starts_turn(double distance_m, const Twist2& twist) const {
  if (distance_m <= kInner * tolerance_.xy_goal_tolerance) return true;
  if (distance_m > tolerance_.xy_goal_tolerance) return false;
  const bool is_receding = distance_m > nearest_m_ + kProgress;
  return is_receding || std::hypot(twist.vx, twist.vy) < kProgress;
}

bool GoalArrival::is_within_fallback(const RobotState& state, double distance_m, double yaw_error) {
  if (distance_m < nearest_m_ - kProgress) {
    nearest_m_ = distance_m;
    least_yaw_error_ = yaw_error;
    nearest_time_s_ = state.time_s;
  }
  // Next to the goal a robot that shuttles comes no nearer, but turns.
  if (yaw_error < least_yaw_error_ - kTurned) {
    least_yaw_error_ = yaw_error;
    nearest_time_s_ = state.time_s;
  }
  return state.time_s - nearest_time_s_ >= tolerance_.fallback_time &&
         distance_m <= tolerance_.fallback_factor * tolerance_.xy_goal_tolerance &&
         yaw_error <= tolerance_.fallback_factor * tolerance_.yaw_goal_tolerance;
}

ArrivalPhase GoalArrival::update(const RobotState& state, const Pose2& goal) {
  const double distance_m = distance(state.pose.x, state.pose.y, goal.x, goal.y);
  const double yaw_error = std::fabs(wrap_angle(goal.yaw - state.pose.yaw));
  const bool is_new = !has_goal_ || !is_same(goal, goal_, tolerance_);
  goal_ = goal;
  if (is_new) {
    has_goal_ = true;
    phase_ = ArrivalPhase::kApproach;
    nearest_m_ = distance_m;
    least_yaw_error_ = yaw_error;
    nearest_time_s_ = state.time_s;
  }
  const bool is_fallback = is_within_fallback(state, distance_m, yaw_error);
  const bool is_at_position = distance_m <= tolerance_.xy_goal_tolerance || is_fallback;
  const bool is_at_heading = yaw_error <= tolerance_.yaw_goal_tolerance || is_fallback;
  if (phase_ == ArrivalPhase::kApproach && can_turn_ && starts_turn(distance_m, state.twist)) {
    phase_ = ArrivalPhase::kTurn;
  }
  if (phase_ == ArrivalPhase::kTurn && !is_at_position) phase_ = ArrivalPhase::kApproach;
  const bool has_arrived =
      can_turn_ ? phase_ == ArrivalPhase::kTurn || is_fallback : is_at_position;
  if (has_arrived && is_at_heading && is_stopped(state.twist)) return ArrivalPhase::kReached;
  return phase_;
}

}  // namespace trident::nav
