// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "drive_pains.h"

#include <algorithm>
#include <cmath>

#include "stepped_drive.h"
#include "trident_base/angle.h"
#include "trident_base/random_stream.h"
#include "trident_nav_ros/move_base_params.h"

namespace trident::benchmarks {
namespace {

double between(const nav::Pose2& a, const nav::Pose2& b) {
  return nav::distance(a.x, a.y, b.x, b.y);
}

double speed_of(SteppedDrive& drive) {
  const Eigen::Vector3d& v = drive.robot().model().links.front()->body->velocity();
  return std::hypot(v.x(), v.y());
}

nav::ControlSetup control_setup(const ConfigNode& parameters) {
  nav::Warnings warnings;
  std::string name = "dwa_local_planner/DWAPlannerROS";
  if (const ConfigNode* given = parameters.find("base_local_planner")) name = given->scalar;
  const std::string space = nav::plugin_namespace(name);
  return nav::read_controller_config(parameters.find(space), space, &warnings).setup;
}

void run_until(SteppedDrive& drive, double time_s) {
  while (drive.time_s() < time_s) drive.step();
}

/// Steps without scans, and notes when and where the robot stands.
void wait_silently(SteppedDrive& drive, double until_s, Silence* result) {
  constexpr double kStands = 0.01;  // [m/s]
  const double begun_s = drive.time_s();
  const nav::Pose2 from = drive.robot().truth();
  while (drive.time_s() < until_s && speed_of(drive) > kStands) drive.step();
  const nav::Pose2 stood = drive.robot().truth();
  result->stopped_s = drive.time_s() - begun_s;
  result->traveled_m = between(from, stood);
  while (drive.time_s() < until_s) {
    const auto output = drive.step();
    if (output && !output->waiting.empty()) result->waiting = output->waiting;
  }
  result->moved_later_m = between(stood, drive.robot().truth());
}

bool reaches_goal(SteppedDrive& drive, double until_s) {
  while (drive.time_s() < until_s) {
    const auto output = drive.step();
    if (!output || output->status == nav::NavigatorStatus::kActive) continue;
    return output->status == nav::NavigatorStatus::kSucceeded;
  }
  return false;
}

/// Sends a robot to goals near itself.
class NearGoals {
 public:
  NearGoals(const DrivePainConfig& config, const ConfigNode& parameters, std::uint64_t seed)
      : random_(seed, "near goals"),
        tolerance_m_(control_setup(parameters).tolerance.xy_goal_tolerance),
        drive_(config.trial, parameters, seed) {
    run_until(drive_, config.trial.settle_s);
  }

  NearGoal drive_to_next() {
    NearGoal result;
    const nav::Pose2 goal = draw_goal(&result);
    drive_.set_goal(goal);
    const double begun_s = drive_.time_s();
    bool was_near = false;
    while (!has_ended_ && drive_.time_s() < begun_s + kLimit_s) {
      const auto output = drive_.step();
      note_distance(goal, &was_near, &result);
      if (output) note(*output, &result);
    }
    result.time_s = drive_.time_s() - begun_s;
    const double after_s = drive_.time_s() + kAfter_s;
    while (drive_.time_s() < after_s) {
      drive_.step();
      note_distance(goal, &was_near, &result);
    }
    has_ended_ = false;
    return result;
  }

 private:
  static constexpr double kLimit_s = 40.0;  // for a goal
  static constexpr double kAfter_s = 0.5;   // while the robot may still roll
  static constexpr double kNear_m = 0.05, kFar_m = 1.0;
  static constexpr double kHome_m = 1.0;  // farther from the start, goals lead back

  nav::Pose2 draw_goal(NearGoal* result) {
    const nav::Pose2 from = drive_.robot().odometry().pose();
    const std::uint64_t draw = draws_++;
    result->distance_m = kNear_m + (kFar_m - kNear_m) * random_.uniform(draw, 0);
    const double direction = std::hypot(from.x, from.y) > kHome_m
                                 ? std::atan2(-from.y, -from.x)
                                 : from.yaw + 2.0 * kPi * random_.uniform(draw, 1);
    result->bearing_rad = nav::wrap_angle(direction - from.yaw);
    result->turn_rad = 2.0 * kPi * (random_.uniform(draw, 2) - 0.5);
    return {from.x + result->distance_m * std::cos(direction),
            from.y + result->distance_m * std::sin(direction),
            nav::wrap_angle(from.yaw + result->turn_rad)};
  }

  void note_distance(const nav::Pose2& goal, bool* was_near, NearGoal* result) {
    const double off_m = between(drive_.robot().odometry().pose(), goal);
    *was_near = *was_near || off_m <= tolerance_m_;
    if (*was_near) result->overshoot_m = std::max(result->overshoot_m, off_m - tolerance_m_);
  }

  void note(const nav::NavigatorOutput& output, NearGoal* result) {
    result->recoveries += output.recovery ? 1 : 0;
    if (output.status == nav::NavigatorStatus::kActive) return;
    result->is_reached = output.status == nav::NavigatorStatus::kSucceeded;
    result->text = output.text;
    has_ended_ = true;
  }

  RandomStream random_;
  double tolerance_m_;
  SteppedDrive drive_;
  std::uint64_t draws_ = 0;
  bool has_ended_ = false;
};

}  // namespace

Silence fall_silent(const DrivePainConfig& config, const ConfigNode& parameters,
                    std::uint64_t seed) {
  constexpr double kFull = 0.95;  // of the greatest speed
  constexpr double kSilent_s = 5.0;
  const double top = control_setup(parameters).limits.vx_max;
  SteppedDrive drive(config.trial, parameters, seed);
  run_until(drive, config.trial.settle_s);
  drive.set_goal({config.trial.goal[0], config.trial.goal[1], config.trial.goal[2]});
  const double end_s = config.trial.settle_s + config.trial.time_limit_s;
  while (drive.time_s() < end_s && speed_of(drive) < kFull * top) drive.step();
  Silence result;
  result.speed_m_s = speed_of(drive);
  drive.set_lidar_on(false);
  wait_silently(drive, drive.time_s() + kSilent_s, &result);
  drive.set_lidar_on(true);
  result.has_continued = reaches_goal(drive, end_s);
  return result;
}

std::vector<NearGoal> drive_near_goals(const DrivePainConfig& config, const ConfigNode& parameters,
                                       std::uint64_t seed) {
  NearGoals drive(config, parameters, seed);
  std::vector<NearGoal> results;
  for (int i = 0; i < config.goals; ++i) results.push_back(drive.drive_to_next());
  return results;
}

}  // namespace trident::benchmarks
