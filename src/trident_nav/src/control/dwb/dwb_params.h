// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/config_types.h"

namespace trident::nav {

/// How sampled velocities become trajectories.
enum class DwbGenerator {
  kStandard,      ///< Those that are reached within the trajectory.
  kLimitedAccel,  ///< Those that are reached within a period, from its begin.
};
constexpr auto enum_names(DwbGenerator) {
  return std::array{EnumName{DwbGenerator::kStandard, "dwb_plugins::StandardTrajectoryGenerator"},
                    EnumName{DwbGenerator::kLimitedAccel, "dwb_plugins::LimitedAccelGenerator"}};
}

/// Names and defaults of Nav2's dwb_core::DWBLocalPlanner; speeds and accelerations without a value
/// are those of the robot's limits. The critics' own keys are in a map of the critic's name.
struct DwbParams {
  std::vector<std::string> critics = {"RotateToGoal", "Oscillation", "BaseObstacle", "GoalAlign",
                                      "PathAlign",    "PathDist",    "GoalDist"};
  std::vector<std::string> default_critic_namespaces = {"dwb_critics"};
  bool prune_plan = true;
  double prune_distance = 2.0;
  double forward_prune_distance = 2.0;
  bool shorten_transformed_plan = true;
  bool short_circuit_trajectory_evaluation = true;
  DwbGenerator trajectory_generator_name = DwbGenerator::kStandard;
  double min_vel_x = 0.0;
  std::optional<double> min_vel_y, max_vel_x, max_vel_y, max_vel_theta;
  double min_speed_xy = 0.0, min_speed_theta = 0.0;
  std::optional<double> max_speed_xy;
  std::optional<double> acc_lim_x, acc_lim_y, acc_lim_theta;
  std::optional<double> decel_lim_x, decel_lim_y, decel_lim_theta;
  double sim_time = 1.7;
  bool discretize_by_time = false;
  double time_granularity = 0.5;
  double linear_granularity = 0.5;
  double angular_granularity = 0.025;
  bool include_last_point = true;
  bool limit_vel_cmd_in_traj = false;
  int vx_samples = 20;
  int vy_samples = 5;
  int vtheta_samples = 20;
  double moving_obstacle_scale = 1.0;

  template <class Archive>
  void visit(Archive& ar) {
    visit_plan(ar);
    visit_speeds(ar);
    visit_accelerations(ar);
    visit_simulation(ar);
  }

 private:
  template <class Archive>
  void visit_plan(Archive& ar) {
    ar.field("critics", critics, "names of those that score");
    ar.field("default_critic_namespaces", default_critic_namespaces, "of names without one");
    ar.field("prune_plan", prune_plan, "the path is cut behind the robot, here always");
    ar.field("prune_distance", prune_distance, Range::positive(), "behind the robot [m]");
    ar.field("forward_prune_distance", forward_prune_distance, Range::positive(),
             "of the path ahead that is looked at, if trajectories do not get farther [m]");
    ar.field("shorten_transformed_plan", shorten_transformed_plan,
             "the path ahead is cut, here always");
    ar.field("short_circuit_trajectory_evaluation", short_circuit_trajectory_evaluation,
             "what cannot become the best one is not scored to its end, here always");
    ar.field("moving_obstacle_scale", moving_obstacle_scale, Range::non_negative(),
             "of nearness to moving obstacles");
  }
  template <class Archive>
  void visit_speeds(Archive& ar) {
    ar.field("min_vel_x", min_vel_x, Range::at_most(0.0), "negative: backwards [m/s]");
    ar.field("min_vel_y", min_vel_y, Range::at_most(0.0), "[m/s]");
    ar.field("max_vel_x", max_vel_x, Range::positive(), "[m/s]");
    ar.field("max_vel_y", max_vel_y, Range::non_negative(), "[m/s]");
    ar.field("max_vel_theta", max_vel_theta, Range::positive(), "[rad/s]");
    ar.field("min_speed_xy", min_speed_xy, Range::non_negative(), "[m/s]");
    ar.field("max_speed_xy", max_speed_xy, Range::positive(), "[m/s]");
    ar.field("min_speed_theta", min_speed_theta, Range::non_negative(),
             "of turns on the spot [rad/s]");
  }
  template <class Archive>
  void visit_accelerations(Archive& ar) {
    constexpr Range kNegative{-1e9, 0.0, false, true};
    ar.field("acc_lim_x", acc_lim_x, Range::positive(), "[m/s^2]");
    ar.field("acc_lim_y", acc_lim_y, Range::non_negative(), "[m/s^2]");
    ar.field("acc_lim_theta", acc_lim_theta, Range::positive(), "[rad/s^2]");
    ar.field("decel_lim_x", decel_lim_x, kNegative, "[m/s^2]");
    ar.field("decel_lim_y", decel_lim_y, Range::at_most(0.0), "[m/s^2]");
    ar.field("decel_lim_theta", decel_lim_theta, kNegative, "[rad/s^2]");
  }
  template <class Archive>
  void visit_simulation(Archive& ar) {
    ar.field("trajectory_generator_name", trajectory_generator_name,
             "how velocities become trajectories");
    ar.field("sim_time", sim_time, Range::positive(), "length of trajectories [s]");
    ar.field("discretize_by_time", discretize_by_time,
             "time_granularity is used, not those of distance and angle");
    ar.field("time_granularity", time_granularity, Range::positive(), "between their points [s]");
    ar.field("linear_granularity", linear_granularity, Range::positive(),
             "between their points [m]");
    ar.field("angular_granularity", angular_granularity, Range::positive(),
             "between their points [rad]");
    ar.field("include_last_point", include_last_point, "the end is scored, here always");
    ar.field("limit_vel_cmd_in_traj", limit_vel_cmd_in_traj,
             "the command is held within what a period reaches, here always");
    ar.field("vx_samples", vx_samples, Range{1, 1000}, "velocities tried");
    ar.field("vy_samples", vy_samples, Range{0, 1000}, "velocities tried");
    ar.field("vtheta_samples", vtheta_samples, Range{1, 1000}, "velocities tried");
  }
};

}  // namespace trident::nav
