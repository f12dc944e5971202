// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "trident_base/config_types.h"

namespace trident::nav {

/// Names and defaults of dwa_local_planner/DWAPlannerROS; speeds and accelerations without a value
/// are those of the robot's limits.
struct DwaParams {
  std::optional<double> max_vel_trans, max_vel_x, max_vel_y, min_vel_y, max_vel_theta;
  double min_vel_x = 0.0;
  double min_vel_trans = 0.1;
  double min_vel_theta = 0.4;
  std::optional<double> acc_lim_x, acc_lim_y, acc_lim_theta, acc_lim_trans;
  double sim_time = 1.7;
  double sim_granularity = 0.025;
  double angular_sim_granularity = 0.1;
  // As upstream documents them; those of its code leave costs alone to decide.
  double path_distance_bias = 32.0;
  double goal_distance_bias = 24.0;
  double occdist_scale = 0.01;
  double twirling_scale = 0.0;
  double stop_time_buffer = 0.2;
  double oscillation_reset_dist = 0.05;
  double oscillation_reset_angle = 0.2;
  double forward_point_distance = 0.325;
  double scaling_speed = 0.25;
  double max_scaling_factor = 0.2;
  double cheat_factor = 1.0;
  bool sum_scores = false;
  int vx_samples = 3;
  int vy_samples = 10;
  int vth_samples = 20;
  bool use_dwa = true;
  bool prune_plan = true;
  double moving_obstacle_scale = 1.0;
  bool publish_traj_pc = false;
  bool publish_cost_grid_pc = false;

  template <class Archive>
  void visit(Archive& ar) {
    visit_limits(ar);
    visit_simulation(ar);
    visit_scoring(ar);
  }

 private:
  template <class Archive>
  void visit_limits(Archive& ar) {
    ar.field("max_vel_trans", max_vel_trans, Range::positive(), "[m/s]");
    ar.field("min_vel_trans", min_vel_trans, Range::non_negative(), "[m/s]");
    ar.field("max_vel_x", max_vel_x, Range::positive(), "[m/s]");
    ar.field("min_vel_x", min_vel_x, "negative: backwards [m/s]");
    ar.field("max_vel_y", max_vel_y, Range::non_negative(), "[m/s]");
    ar.field("min_vel_y", min_vel_y, Range::at_most(0.0), "[m/s]");
    ar.field("max_vel_theta", max_vel_theta, Range::positive(), "[rad/s]");
    ar.field("min_vel_theta", min_vel_theta, Range::non_negative(), "of turns on the spot [rad/s]");
    ar.field("acc_lim_x", acc_lim_x, Range::positive(), "[m/s^2]");
    ar.field("acc_lim_y", acc_lim_y, Range::positive(), "[m/s^2]");
    ar.field("acc_lim_theta", acc_lim_theta, Range::positive(), "[rad/s^2]");
    ar.field("acc_lim_trans", acc_lim_trans, Range::positive(), "[m/s^2]");
  }
  template <class Archive>
  void visit_simulation(Archive& ar) {
    ar.field("sim_time", sim_time, Range::positive(), "length of trajectories [s]");
    ar.field("sim_granularity", sim_granularity, Range::positive(), "between their points [m]");
    ar.field("angular_sim_granularity", angular_sim_granularity, Range::positive(),
             "between their points [rad]");
    ar.field("vx_samples", vx_samples, Range{1, 1000}, "velocities tried");
    ar.field("vy_samples", vy_samples, Range{0, 1000}, "velocities tried");
    ar.field("vth_samples", vth_samples, Range{1, 1000}, "velocities tried");
    ar.field("use_dwa", use_dwa,
             "velocities that are reached within a period; else within sim_time");
    ar.field("prune_plan", prune_plan, "the path is cut behind the robot, here always");
  }
  template <class Archive>
  void visit_scoring(Archive& ar) {
    ar.field("path_distance_bias", path_distance_bias, Range::non_negative(), "of the deviation");
    ar.field("goal_distance_bias", goal_distance_bias, Range::non_negative(), "of progress");
    ar.field("occdist_scale", occdist_scale, Range::non_negative(), "of costs");
    ar.field("twirling_scale", twirling_scale, Range::non_negative(), "of turning");
    ar.field("moving_obstacle_scale", moving_obstacle_scale, Range::non_negative(),
             "of nearness to moving obstacles");
    ar.field("stop_time_buffer", stop_time_buffer, Range::non_negative(), "[s]");
    ar.field("oscillation_reset_dist", oscillation_reset_dist, Range::non_negative(), "[m]");
    ar.field("oscillation_reset_angle", oscillation_reset_angle, Range::non_negative(), "[rad]");
    ar.field("forward_point_distance", forward_point_distance, Range::non_negative(),
             "of a second scored point ahead of the base [m]");
    ar.field("scaling_speed", scaling_speed, Range::non_negative(),
             "from which the footprint would grow; the guard replaces it [m/s]");
    ar.field("max_scaling_factor", max_scaling_factor, Range::non_negative(),
             "of the footprint; the guard replaces it");
    ar.field(
        "cheat_factor", cheat_factor, Range::non_negative(),
        "times forward_point_distance from the goal, and within the tolerance, the point ahead "
        "is silent");
    ar.field("sum_scores", sum_scores, "scores of all poses, not of the last one");
    ar.field("publish_traj_pc", publish_traj_pc, "`trajectory_cloud` has all trajectories tried");
    ar.field("publish_cost_grid_pc", publish_cost_grid_pc, "`cost_cloud` has the scores of cells");
  }
};

}  // namespace trident::nav
