// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trial.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <deque>

#include "navigation_stack.h"
#include "simulated_robot.h"

namespace trident::benchmarks {
namespace {

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double between(const nav::Pose2& a, const nav::Pose2& b) {
  return nav::distance(a.x, a.y, b.x, b.y);
}

nav::Pose2 placed(const nav::Pose2& frame, const nav::Pose2& pose) {
  const nav::Point2 p = nav::transform(frame, {pose.x, pose.y});
  return {p.x, p.y, nav::wrap_angle(frame.yaw + pose.yaw)};
}

nav::Pose2 pose_of(const std::array<double, 3>& values) {
  return {values[0], values[1], values[2]};
}

/// One run while it lasts.
class Trial {
 public:
  Trial(const TrialConfig& config, const ConfigNode& parameters, std::uint64_t seed)
      : config_(config),
        robot_(config, seed),
        stack_(parameters),
        goal_(placed(pose_of(config.start), pose_of(config.goal))) {}

  TrialResult run() {
    while (!is_over_ && robot_.time_s() < config_.settle_s + config_.time_limit_s) {
      send_commands();
      robot_.step();
      if (auto scan = robot_.take_scan()) stack_.add_scan(*scan);
      judge();
      if (!is_over_ && stack_.is_control_due(robot_.time_s())) control();
    }
    result_.time_s = moved_s_ < 0.0 ? 0.0 : robot_.time_s() - moved_s_;
    result_.odometry_error_m =
        between(placed(pose_of(config_.start), robot_.odometry().pose()), robot_.truth());
    return result_;
  }

 private:
  void end(TrialEnd how, std::string text) {
    result_.end = how;
    result_.text = std::move(text);
    is_over_ = true;
  }

  void judge() {
    const nav::Pose2 truth = robot_.truth();
    if (moved_s_ < 0.0 && between(truth, pose_of(config_.start)) >= config_.moved_m) {
      moved_s_ = robot_.time_s();
    }
    const bool is_new =
        result_.track.empty() || between(truth, result_.track.back()) >= config_.track_step_m;
    if (is_new) result_.track.push_back(truth);
    const std::string touched = robot_.touched();
    if (!touched.empty()) {
      end(TrialEnd::kCollided, touched);
    } else if (between(truth, goal_) < config_.success_radius_m) {
      end(TrialEnd::kReached, "");
    }
  }

  void control() {
    const double now_s = robot_.time_s();
    const double begin_s = thread_cpu_s();
    if (!has_goal_ && now_s >= config_.settle_s) {
      stack_.set_goal(pose_of(config_.goal), now_s);
      has_goal_ = true;
    }
    const WheelOdometry& odometry = robot_.odometry();
    const nav::NavigatorOutput output =
        stack_.cycle(now_s, {odometry.pose(), odometry.twist(), robot_.odometry_time_s()});
    result_.navigation_cpu_s += thread_cpu_s() - begin_s;
    result_.top_speed_m_s = std::max(result_.top_speed_m_s, odometry.twist().vx);
    if (output.recovery) {
      result_.recoveries.push_back(output.recovery->name + ": " + output.recovery->cause);
    }
    if (output.status == nav::NavigatorStatus::kAborted) end(TrialEnd::kAborted, output.text);
    if (output.status == nav::NavigatorStatus::kSucceeded) end(TrialEnd::kReached, output.text);
    if (has_goal_) commands_.push_back({now_s + config_.command_delay_s, output.twist});
  }

  void send_commands() {
    while (!commands_.empty() && commands_.front().due_s <= robot_.time_s()) {
      robot_.command(commands_.front().twist);
      commands_.pop_front();
    }
  }

  const TrialConfig& config_;
  SimulatedRobot robot_;
  NavigationStack stack_;
  nav::Pose2 goal_;  ///< In the world.
  TrialResult result_;
  struct Command {
    double due_s;
    nav::Twist2 twist;
  };
  std::deque<Command> commands_;  ///< Not yet at the base.
  double moved_s_ = -1.0;         ///< When it had moved; negative: not yet.
  bool has_goal_ = false, is_over_ = false;
};

}  // namespace

std::string name_of(TrialEnd end) {
  switch (end) {
    case TrialEnd::kReached:
      return "reached";
    case TrialEnd::kCollided:
      return "collided";
    case TrialEnd::kAborted:
      return "aborted";
    case TrialEnd::kTimeout:
      break;
  }
  return "timeout";
}

TrialResult run_trial(const TrialConfig& config, const ConfigNode& parameters, std::uint64_t seed) {
  return Trial(config, parameters, seed).run();
}

}  // namespace trident::benchmarks
