// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trial.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <utility>

#include "map_localizer.h"
#include "navigation_stack.h"
#include "simulated_robot.h"
#include "thread_cpu.h"
#include "trident_maps/map_file.h"

namespace trident::benchmarks {
namespace {

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

SE2 to_se2(const nav::Pose2& pose) { return SE2::from_xy_yaw(pose.x, pose.y, pose.yaw); }

nav::Pose2 to_pose2(const SE2& T) { return {T.p.x(), T.p.y(), T.angle}; }

std::vector<nav::Pose2> goals_of(const TrialConfig& config) {
  std::vector<nav::Pose2> goals;
  for (const auto& goal : config.goals) goals.push_back(pose_of(goal));
  if (goals.empty()) goals.push_back(placed(pose_of(config.start), pose_of(config.goal)));
  return goals;
}

/// The map's frame in the world; without a map the one that odometry begins with.
SE2 map_frame(const TrialConfig& config) {
  return to_se2(pose_of(config.map.file.empty() ? config.start : config.map.pose));
}

/// One run while it lasts.
class Trial {
 public:
  Trial(const TrialConfig& config, const ConfigNode& parameters, std::uint64_t seed)
      : config_(config),
        robot_(config, seed),
        stack_(parameters),
        T_map_world_(map_frame(config).inverse()),
        goals_(goals_of(config)) {
    if (config.map.file.empty()) return;
    const OccupancyGrid map = maps::load_map(config.map.file);
    stack_.set_map(map);
    localizer_ = std::make_unique<MapLocalizer>(config.map, map,
                                                T_map_world_ * to_se2(pose_of(config.start)), seed);
  }

  TrialResult run() {
    while (!is_over_) {
      send_commands();
      robot_.step();
      if (auto scan = robot_.take_scan()) take_scan(*scan);
      judge();
      if (!is_over_ && stack_.is_control_due(robot_.time_s())) control();
    }
    result_.time_s = moved_s_ < 0.0 ? 0.0 : robot_.time_s() - moved_s_;
    result_.odometry_error_m =
        between(placed(pose_of(config_.start), robot_.odometry().pose()), robot_.truth());
    return result_;
  }

 private:
  void take_scan(const PlacedScan& scan) {
    if (localizer_) {
      localizer_->add_scan(scan);
      stack_.set_map_pose(localizer_->T_map_odom());
    }
    stack_.add_scan(scan);
  }

  void begin_goal() {
    result_.goals.emplace_back();
    GoalResult& tried = result_.goals.back();
    tried.goal = goals_[result_.goals.size() - 1];
    begun_s_ = robot_.time_s();
    stack_.set_goal(to_pose2(T_map_world_ * to_se2(tried.goal)), begun_s_);
    is_driving_ = true;
  }

  void end_goal(TrialEnd how, std::string text) {
    GoalResult& tried = result_.goals.back();
    const nav::Pose2 truth = robot_.truth();
    tried.end = result_.end = how;
    tried.text = result_.text = std::move(text);
    tried.time_s = robot_.time_s() - begun_s_;
    tried.position_error_m = between(truth, tried.goal);
    tried.heading_error_rad = std::fabs(nav::wrap_angle(truth.yaw - tried.goal.yaw));
    note_localization(truth);
    is_driving_ = false;
    const bool is_stopped = how == TrialEnd::kCollided && config_.ends_at_contact;
    is_over_ = is_stopped || result_.goals.size() == goals_.size();
    if (!is_over_) stack_.cancel();
  }

  void note_localization(const nav::Pose2& truth) {
    if (!localizer_) return;
    const SE2 T_map_base = localizer_->T_map_odom() * to_se2(robot_.odometry().pose());
    const double error_m = between(to_pose2(T_map_world_.inverse() * T_map_base), truth);
    result_.localization_error_m = std::max(result_.localization_error_m, error_m);
  }

  void note_track(const nav::Pose2& truth) {
    if (moved_s_ < 0.0 && between(truth, pose_of(config_.start)) >= config_.moved_m) {
      moved_s_ = robot_.time_s();
    }
    const bool is_new =
        result_.track.empty() || between(truth, result_.track.back()) >= config_.track_step_m;
    if (is_new) result_.track.push_back(truth);
  }

  void judge() {
    const nav::Pose2 truth = robot_.truth();
    note_track(truth);
    if (is_driving_) judge_goal(truth);
  }

  void judge_goal(const nav::Pose2& truth) {
    GoalResult& tried = result_.goals.back();
    if (tried.touched.empty()) tried.touched = robot_.touched();
    if (!tried.touched.empty() && config_.ends_at_contact) {
      end_goal(TrialEnd::kCollided, tried.touched);
    } else if (between(truth, tried.goal) < config_.success_radius_m) {
      end_goal(TrialEnd::kReached, "");
    } else if (robot_.time_s() - begun_s_ >= config_.time_limit_s) {
      end_goal(TrialEnd::kTimeout, "");
    }
  }

  void control() {
    const double now_s = robot_.time_s();
    const double begin_s = thread_cpu_s();
    if (localizer_) {
      localizer_->set_truth(T_map_world_ * to_se2(robot_.truth()),
                            to_se2(robot_.odometry().pose()));
      stack_.set_map_pose(localizer_->T_map_odom());
    }
    if (!is_driving_ && now_s >= config_.settle_s) begin_goal();
    const Odometry& odometry = robot_.odometry();
    const nav::NavigatorOutput output =
        stack_.cycle(now_s, {odometry.pose(), odometry.twist(), robot_.odometry_time_s()});
    result_.navigation_cpu_s += thread_cpu_s() - begin_s;
    result_.top_speed_m_s = std::max(result_.top_speed_m_s, odometry.twist().vx);
    result_.least_speed_m_s = std::min(result_.least_speed_m_s, odometry.twist().vx);
    if (!is_driving_) return;
    commands_.push_back({now_s + config_.command_delay_s, output.twist});
    note(output);
  }

  void note(const nav::NavigatorOutput& output) {
    if (output.recovery) {
      result_.recoveries.push_back(output.recovery->name + ": " + output.recovery->cause);
      ++result_.goals.back().recoveries;
    }
    if (output.status == nav::NavigatorStatus::kAborted) end_goal(TrialEnd::kAborted, output.text);
    if (output.status == nav::NavigatorStatus::kSucceeded)
      end_goal(TrialEnd::kReached, output.text);
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
  std::unique_ptr<MapLocalizer> localizer_;  ///< With a map.
  SE2 T_map_world_;
  std::vector<nav::Pose2> goals_;  ///< In the world.
  TrialResult result_;
  struct Command {
    double due_s;
    nav::Twist2 twist;
  };
  std::deque<Command> commands_;  ///< Not yet at the base.
  double moved_s_ = -1.0;         ///< When it had moved; negative: not yet.
  double begun_s_ = 0.0;          ///< When the goal was given.
  bool is_driving_ = false, is_over_ = false;
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
