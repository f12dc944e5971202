// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "navigation_stack.h"
#include "simulated_robot.h"
#include "trial_config.h"

namespace trident::benchmarks {

/// A simulated robot and the navigation that drives it, one step of the physics at a time, so that
/// a scene can change the world, the lidar or the goal in between. One thread.
class SteppedDrive {
 public:
  /// `parameters`: of move_base. Throws Error naming file, port, joint or parameter.
  SteppedDrive(const TrialConfig& config, const ConfigNode& parameters, std::uint64_t seed);

  /// A goal in the frame of odometry, in place of any other.
  void set_goal(const nav::Pose2& goal) { stack_.set_goal(goal, robot_.time_s()); }
  /// Without it, scans are not given to the navigation.
  void set_lidar_on(bool is_on) { is_lidar_on_ = is_on; }
  /// The navigation then has the robot's true pose, from its start, instead of the odometry's: as
  /// if it were localized in a map.
  void set_localized(bool is_localized) { is_localized_ = is_localized; }
  /// One step of the physics; what the navigation wants if its period was over.
  std::optional<nav::NavigatorOutput> step();

  double time_s() const { return robot_.time_s(); }
  SimulatedRobot& robot() { return robot_; }
  const NavigationStack& stack() const { return stack_; }
  /// The newest command, which may not have reached the base yet.
  const nav::Twist2& command() const { return command_; }
  /// CPU time of costmaps, planner and controller so far.
  double navigation_cpu_s() const { return navigation_cpu_s_; }

 private:
  struct Command {
    double due_s;
    nav::Twist2 twist;
  };

  nav::Pose2 pose() const;
  void send_commands();
  void hand_over_scan();

  nav::Pose2 start_;
  double command_delay_s_;
  SimulatedRobot robot_;
  NavigationStack stack_;
  std::deque<Command> underway_;  ///< Not yet at the base.
  nav::Twist2 command_;
  double navigation_cpu_s_ = 0.0;
  bool is_lidar_on_ = true, is_localized_ = false;
};

}  // namespace trident::benchmarks
