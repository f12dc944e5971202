// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/navigator/navigator.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "trident_base/angle.h"
#include "trident_base/string_util.h"
#include "trident_nav/control/motion.h"

namespace trident::nav {
namespace {

// After a recovery the costmaps and the planner have this long before the next one begins.
constexpr double kGrace_s = 1.0;
// Where no command is found, new paths are asked for at least so often [Hz].
constexpr double kReplanRate = 2.0;
constexpr double kTrailSpacing_m = 0.05;
constexpr double kTrailTurn = 0.2;  // [rad]
constexpr std::size_t kTrailPoses = 400;
// A robot that moves farther in a period was put somewhere else.
constexpr double kJump_m = 1.0;

std::string place_text(const Pose2& pose) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.2f, %.2f)", pose.x, pose.y);
  return text;
}

/// `pose` is given in the axes of `frame`.
Pose2 placed(const Pose2& frame, const Pose2& pose) {
  const Point2 p = transform(frame, {pose.x, pose.y});
  return {p.x, p.y, wrap_angle(frame.yaw + pose.yaw)};
}

Pose2 inverse(const Pose2& pose) {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  return {-c * pose.x - s * pose.y, s * pose.x - c * pose.y, -pose.yaw};
}

std::string joined_texts(const std::vector<StaleSource>& sources) {
  std::vector<std::string> texts;
  texts.reserve(sources.size());
  for (const StaleSource& source : sources) texts.push_back(source.text());
  return join(texts, "; ");
}

/// Where the robot is now, if it has moved since its pose was measured as it did then.
NavigatorInput at_present(NavigatorInput input) {
  constexpr double kMaxAge_s = 0.3;  // nobody knows what it has done in longer times
  const double age_s = input.now_s - input.state.time_s;
  if (!(age_s > 0.0)) return input;
  input.state.time_s = input.now_s;  // times of states never decrease
  if (age_s > kMaxAge_s) return input;
  const Pose2 moved = integrate({}, input.state.twist, age_s);
  input.state.pose = placed(input.state.pose, moved);
  input.robot_global = placed(input.robot_global, moved);
  return input;
}

// Of two velocities the one nearer to 0; 0 where they have different signs.
double slower(double a, double b) {
  if (a * b <= 0.0) return 0.0;
  return std::fabs(a) < std::fabs(b) ? a : b;
}

bool has_jumped(const Pose2& from, const Pose2& to) {
  return distance(from.x, from.y, to.x, to.y) > kJump_m;
}

bool is_same_place(const Pose2& from, const Pose2& to) {
  return distance(from.x, from.y, to.x, to.y) < kTrailSpacing_m &&
         std::fabs(wrap_angle(to.yaw - from.yaw)) < kTrailTurn;
}

}  // namespace

Navigator::Navigator(NavigatorParts parts, NavigatorWorld& world, Controller& controller)
    : parts_(std::move(parts)),
      world_(world),
      controller_(controller),
      keeper_(parts_.params),
      last_command_(parts_.limits, 1.0 / parts_.params.controller_frequency) {}

void Navigator::set_parts(NavigatorParts parts) {
  parts_ = std::move(parts);
  keeper_.set_params(parts_.params);
  last_command_ = {parts_.limits, 1.0 / parts_.params.controller_frequency};
  next_recovery_ = std::min(next_recovery_, parts_.recoveries.size());
}

/// From now on the robot has not moved.
void Navigator::Patience::begin_motion(const Pose2& from, double now_s) {
  motion_from = from;
  motion_s = now_s;
  path_left_m.reset();
}

void Navigator::forget_progress(double now_s) {
  replaced_.is_blocked = false;
  since_ = Patience{};
  since_.plan_s = since_.command_s = since_.step_s = since_.progress_s = since_.advance_s = now_s;
  since_.request_s = -1e9;
}

void Navigator::set_goal(const Pose2& goal, double now_s) {
  world_.cancel_plan();
  world_.avoid({});
  controller_.reset();
  keeper_.clear();
  forget_progress(now_s);
  goal_ = goal;
  next_recovery_ = 0;
  tried_.clear();
  slow_.drive.reset();
  cause_.clear();
  since_.begin_motion(trail_.empty() ? Pose2{} : trail_.back(), now_s);
  phase_ = Phase::kPlanning;
}

void Navigator::cancel() {
  world_.cancel_plan();
  controller_.reset();
  keeper_.clear();
  phase_ = Phase::kIdle;
}

/// From what the base is about to do: odometry is late, and braking from what it says would be
/// slow.
Twist2 Navigator::braking(const NavigatorInput& input) const {
  return braked(parts_.limits, last_command_.motion(input.state),
                1.0 / parts_.params.controller_frequency);
}

/// Adds a pose to the trail. False: the robot has not moved on since the last one.
bool Navigator::extend_trail(const Pose2& pose) {
  if (!trail_.empty() && has_jumped(trail_.back(), pose)) trail_.clear();
  if (!trail_.empty() && is_same_place(trail_.back(), pose)) return false;
  if (trail_.size() >= kTrailPoses) trail_.erase(trail_.begin(), trail_.begin() + kTrailPoses / 2);
  trail_.push_back(pose);
  return true;
}

/// Keeps the trail, and notes whether the robot gets anywhere: only that makes the recoveries begin
/// again.
void Navigator::note_motion(const NavigatorInput& input) {
  const Pose2& pose = input.state.pose;
  if (!extend_trail(pose)) return;
  const double away_m = distance(since_.motion_from.x, since_.motion_from.y, pose.x, pose.y);
  if (away_m < parts_.params.oscillation_distance) return;
  since_.begin_motion(pose, input.now_s);
  if (phase_ == Phase::kControlling) next_recovery_ = 0;
}

bool Navigator::waits_for_sources(const NavigatorInput& input, NavigatorOutput* output) {
  const std::vector<StaleSource> stale = world_.stale_sources(input.now_s);
  if (stale.empty()) return false;
  const double waited_s = std::max(input.now_s - since_.step_s, 0.0);
  for (double* since : {&since_.plan_s, &since_.command_s, &since_.motion_s, &since_.progress_s,
                        &since_.advance_s, &since_.failing_s})
    *since += waited_s;
  // Odometry may be what is silent: what it said last does not change however long this brakes.
  const Twist2 measured = last_command_.motion(input.state);
  const Twist2 sent = last_command_.newest();
  const Twist2 from{slower(measured.vx, sent.vx), slower(measured.vy, sent.vy),
                    slower(measured.wz, sent.wz)};
  output->twist = braked(parts_.limits, from, 1.0 / parts_.params.controller_frequency);
  output->waiting = "The robot stands until data come: " + joined_texts(stale) + ".";
  return true;
}

NavigatorOutput Navigator::step(const NavigatorInput& given) {
  const NavigatorInput input = at_present(given);
  NavigatorOutput output;
  note_motion(input);
  if (phase_ == Phase::kIdle) {
    last_command_.forget();
    return output;
  }
  output.status = NavigatorStatus::kActive;
  output.twist = braking(input);
  if (!waits_for_sources(input, &output)) {
    if (phase_ == Phase::kRecovering) {
      recover(input, &output);
    } else {
      plan(input, &output);
      if (phase_ == Phase::kControlling) control(input, &output);
      slow_down(input, &output);
    }
  }
  since_.step_s = input.now_s;
  last_command_.note(output.twist, input.state.time_s);
  return output;
}

void Navigator::slow_down(const NavigatorInput& input, NavigatorOutput* output) {
  if (!slow_.drive) return;
  const Pose2& pose = input.state.pose;
  if (distance(pose.x, pose.y, slow_.from.x, slow_.from.y) >= slow_.drive->distance_m) {
    slow_.drive.reset();
  } else {
    output->twist = slow_.drive->limited(output->twist);
  }
}

Twist2 SlowDrive::limited(const Twist2& twist) const {
  const double speed = std::hypot(twist.vx, twist.vy);
  double kept = 1.0;
  if (speed > trans_max) kept = trans_max / speed;
  if (std::fabs(twist.wz) > rot_max) kept = std::min(kept, rot_max / std::fabs(twist.wz));
  return {kept * twist.vx, kept * twist.vy, kept * twist.wz};
}

void Navigator::plan(const NavigatorInput& input, NavigatorOutput* output) {
  const double rate = parts_.params.planner_frequency;
  const double waited_s = input.now_s - since_.request_s;
  const bool is_due = phase_ == Phase::kPlanning ? waited_s * std::max(rate, kReplanRate) >= 1.0
                                                 : rate > 0.0 && waited_s * rate >= 1.0 - 1e-9;
  if (!since_.has_request && is_due) {
    world_.request_plan(input.robot_global, goal_);
    since_.request_s = input.now_s;
    since_.has_request = true;
  }
  if (since_.has_request) take_plan(input, output);
}

void Navigator::take_plan(const NavigatorInput& input, NavigatorOutput* output) {
  std::optional<PlanOutcome> outcome = world_.take_plan();
  if (!outcome) return;
  since_.has_request = false;
  if (outcome->failure != Failure::kNone || outcome->path.empty()) {
    refuse_plan(input, *outcome, output);
    return;
  }
  since_.plan_s = input.now_s;
  since_.failed_plans = 0;
  offer_path(input, std::move(outcome->path), output);
  if (phase_ == Phase::kPlanning) phase_ = Phase::kControlling;
}

/// A new path, which replaces one that is blocked or that the robot is stuck on in any case.
void Navigator::offer_path(const NavigatorInput& input, Path path, NavigatorOutput* output) {
  const double left_m =
      std::max(parts_.footprint.circumscribed_radius, 2.0 * input.local.geometry.resolution);
  const double old_m = keeper_.left_m(input.robot_global);
  const bool is_rerouted = std::exchange(replaced_.is_rerouted, false);
  if (std::exchange(replaced_.is_blocked, false) || is_rerouted) keeper_.clear();
  output->has_new_path =
      keeper_.offer(std::move(path), input.now_s, input.robot_global, left_m, world_);
  // A path around something may be longer than what it replaces.
  const double new_m = keeper_.left_m(input.robot_global);
  if (output->has_new_path && new_m > old_m + parts_.footprint.circumscribed_radius) {
    begin_advance(new_m, input.now_s);
  }
}

/// Which limit on plans that fail is used up; empty: none yet.
std::string Navigator::used_up_text(double failing_s) const {
  const NavigatorParams& params = parts_.params;
  if (params.max_planning_retries >= 0 && since_.failed_plans > params.max_planning_retries) {
    return " max_planning_retries of " + std::to_string(params.max_planning_retries) +
           " is used up.";
  }
  if (!(failing_s >= params.planner_patience)) return "";
  return " planner_patience of " + number_text(params.planner_patience) + " s is over.";
}

/// While an old path is followed, a failed plan changes nothing, unless the robot gets nowhere on
/// that path.
void Navigator::refuse_plan(const NavigatorInput& input, const PlanOutcome& outcome,
                            NavigatorOutput* output) {
  if (since_.failed_plans++ == 0) since_.failing_s = input.now_s;
  const bool is_following = phase_ != Phase::kPlanning;
  if (is_following && !replaced_.is_rerouted) return;
  cause_ = outcome.reason;
  const double since_s = is_following ? since_.failing_s : since_.plan_s;
  const std::string used_up = used_up_text(input.now_s - since_s);
  if (used_up.empty()) return;
  cause_ += used_up;
  begin_recovery(Trigger::kPlanning, input, output);
}

Path Navigator::local_path(const NavigatorInput& input) const {
  const Pose2 T_local_global = placed(input.state.pose, inverse(input.robot_global));
  Path path = keeper_.remaining();
  for (Pose2& pose : path) pose = placed(T_local_global, pose);
  return path;
}

/// How long a robot may stay within its own circle before it counts as stuck: what a tenth of its
/// speed takes to leave it, what turning around takes, and a little patience.
double Navigator::stuck_time_s() const {
  constexpr double kMinimum_s = 2.0, kSlow = 0.1, kTurns = 1.5;
  const MotionLimits& limits = parts_.limits;
  const double leaving_s = parts_.footprint.circumscribed_radius / (kSlow * limits.vx_max);
  const double turning_s = limits.wz_max > 0.0 ? kTurns * kPi / limits.wz_max : 0.0;
  return std::max({kMinimum_s, leaving_s, turning_s});
}

/// When the robot last left its own circle, and when the path that is left last became shorter.
void Navigator::note_progress(const NavigatorInput& input) {
  const double radius_m = parts_.footprint.circumscribed_radius;
  const Pose2 &from = since_.progress_from, &pose = input.state.pose;
  const Pose2& end = keeper_.path().back();
  const bool is_near_end =
      distance(end.x, end.y, input.robot_global.x, input.robot_global.y) < 2.0 * radius_m;
  if (is_near_end || distance(from.x, from.y, pose.x, pose.y) > radius_m) {
    since_.progress_from = pose;
    since_.progress_s = input.now_s;
    replaced_.is_rerouted = false;
  }
  const double left_m = keeper_.left_m(input.robot_global);
  if (is_near_end || !since_.least_left_m || left_m < *since_.least_left_m - radius_m) {
    begin_advance(left_m, input.now_s);
  }
}

/// A robot that gets nowhere although its path leads on looks for another one long before a
/// recovery begins. One that shuttles before a place that it cannot pass gets nowhere, either: but
/// for longer, as nothing but what is left of the path says so.
void Navigator::reroute_if_stuck(const NavigatorInput& input) {
  if (!keeper_.has_path()) return;
  note_progress(input);
  constexpr double kShuttling = 1.5;
  const bool is_stuck = input.now_s - since_.progress_s >= stuck_time_s();
  const bool shuttles = input.now_s - since_.advance_s >= kShuttling * stuck_time_s();
  if (!is_stuck && !shuttles) return;
  since_.progress_s = since_.advance_s = input.now_s;
  world_.avoid(keeper_.remaining());
  world_.request_plan(input.robot_global, goal_);
  since_.request_s = input.now_s;
  since_.has_request = true;
  replaced_.is_rerouted = true;
}

/// From now on a path of this length has to become shorter.
void Navigator::begin_advance(double left_m, double now_s) {
  since_.least_left_m = left_m;
  since_.advance_s = now_s;
}

/// Between parked cars a robot moves without getting away: what it makes good of a path that
/// changes gear counts, too.
void Navigator::note_path_progress(const NavigatorInput& input) {
  if (!keeper_.has_cusps()) return;
  const double left_m = keeper_.left_m(input.robot_global);
  const double was_left_m = since_.path_left_m.value_or(left_m);
  since_.path_left_m = was_left_m;
  if (was_left_m - left_m < parts_.params.oscillation_distance) return;
  since_.path_left_m = left_m;
  since_.motion_from = since_.progress_from = input.state.pose;
  since_.motion_s = since_.progress_s = input.now_s;
  begin_advance(left_m, input.now_s);
}

void Navigator::control(const NavigatorInput& input, NavigatorOutput* output) {
  const NavigatorParams& params = parts_.params;
  keeper_.advance(input.robot_global);
  note_path_progress(input);
  reroute_if_stuck(input);
  if (params.oscillation_timeout > 0.0 &&
      input.now_s - since_.motion_s > params.oscillation_timeout) {
    cause_ = "Within oscillation_timeout of " + number_text(params.oscillation_timeout) +
             " s the robot got less than oscillation_distance of " +
             number_text(params.oscillation_distance) + " m away from " +
             place_text(since_.motion_from) + ".";
    begin_recovery(Trigger::kOscillation, input, output);
    return;
  }
  CommandOutcome outcome =
      controller_.command(input.state, local_path(input), input.local, input.tracks);
  output->twist = outcome.twist;
  if (outcome.goal_reached) {
    finish(NavigatorStatus::kSucceeded, "Goal reached.", output);
  } else if (outcome.failure == Failure::kNone) {
    since_.command_s = input.now_s;
  } else {
    miss_command(input, outcome, output);
  }
}

void Navigator::miss_command(const NavigatorInput& input, const CommandOutcome& outcome,
                             NavigatorOutput* output) {
  cause_ = outcome.reason;
  // A base that turns in circles cannot go around what its path touches: it needs another one.
  replaced_.is_blocked =
      outcome.failure == Failure::kBlocked && parts_.limits.min_turning_radius > 0.0;
  if (input.now_s - since_.command_s >= parts_.params.controller_patience) {
    const std::string obstacle = world_.obstacle_text(input.state.pose);
    cause_ += (obstacle.empty() ? "" : " " + obstacle) + " controller_patience of " +
              number_text(parts_.params.controller_patience) + " s is over.";
    begin_recovery(Trigger::kControlling, input, output);
  } else if (!since_.has_request && (input.now_s - since_.request_s) * kReplanRate >= 1.0) {
    world_.request_plan(input.robot_global, goal_);
    since_.request_s = input.now_s;
    since_.has_request = true;
  }
}

/// The recovery to be tried next, which is noted as tried. A robot that moves to and fro between
/// places where it gets stuck does not begin again with the first at each of them.
std::size_t Navigator::untried_recovery(const Pose2& robot) {
  const double near_m =
      std::max(parts_.params.oscillation_distance, parts_.footprint.circumscribed_radius);
  const auto is_near = [&](const TriedPlace& place) {
    return distance(place.at.x, place.at.y, robot.x, robot.y) < near_m;
  };
  auto place = std::find_if(tried_.begin(), tried_.end(), is_near);
  if (place == tried_.end()) place = tried_.insert(place, TriedPlace{{robot.x, robot.y}, 0});
  const std::size_t next = std::max(next_recovery_, place->count);
  place->count = next + 1;
  return next;
}

void Navigator::begin_recovery(Trigger trigger, const NavigatorInput& input,
                               NavigatorOutput* output) {
  trigger_ = trigger;
  next_recovery_ = untried_recovery(input.robot_global);
  output->twist = braking(input);
  world_.cancel_plan();
  since_.has_request = false;
  if (!parts_.params.recovery_behavior_enabled || next_recovery_ >= parts_.recoveries.size()) {
    const char* sentence = trigger == Trigger::kPlanning      ? "Failed to find a valid plan."
                           : trigger == Trigger::kControlling ? "Failed to find a valid control."
                                                              : "Robot is oscillating.";
    finish(NavigatorStatus::kAborted,
           std::string(sentence) + " Even after executing recovery behaviors. " + cause_, output);
    return;
  }
  NamedRecovery& next = parts_.recoveries[next_recovery_];
  next.recovery->start();
  phase_ = Phase::kRecovering;
  output->recovery = {next.name, next_recovery_, parts_.recoveries.size(), cause_};
}

void Navigator::recover(const NavigatorInput& input, NavigatorOutput* output) {
  NamedRecovery& current = parts_.recoveries[next_recovery_];
  const RecoveryStep step = current.recovery->step(
      {input.now_s, input.state, input.local, input.tracks, trail_, world_, controller_});
  if (!step.is_done) {
    output->twist = step.twist;
    return;
  }
  slow_ = {step.slow, input.state.pose};
  ++next_recovery_;
  phase_ = Phase::kPlanning;
  keeper_.clear();
  controller_.reset();
  const NavigatorParams& params = parts_.params;
  since_.plan_s = std::max(since_.plan_s, input.now_s + kGrace_s - params.planner_patience);
  since_.command_s =
      std::max(since_.command_s, input.now_s + kGrace_s - params.controller_patience);
  since_.begin_motion(input.state.pose, input.now_s);
  since_.failed_plans = 0;
}

void Navigator::finish(NavigatorStatus status, std::string text, NavigatorOutput* output) {
  output->status = status;
  output->text = std::move(text);
  keeper_.clear();
  controller_.reset();
  world_.cancel_plan();
  phase_ = Phase::kIdle;
}

}  // namespace trident::nav
