// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "trident_base/angle.h"
#include "trident_base/config_types.h"

namespace trident::nav {

/// What trajectories are compared with; upstream's `point_grid` is not offered.
enum class WorldModel { kCostmap };
constexpr auto enum_names(WorldModel) {
  return std::array{EnumName{WorldModel::kCostmap, "costmap"}};
}

/// Names and defaults of base_local_planner/TrajectoryPlannerROS; speeds and accelerations without
/// a value are those of the robot's limits.
struct TrajectoryPlannerParams {
  std::optional<double> acc_lim_x, acc_lim_y, acc_lim_theta;
  std::optional<double> max_vel_x, max_vel_theta, min_vel_theta;
  double min_vel_x = 0.1;
  double min_in_place_vel_theta = 0.4;
  double escape_vel = -0.1;
  /// Absent: as the robot's limits have it.
  std::optional<bool> holonomic_robot;
  std::vector<double> y_vels = {-0.3, -0.1, 0.1, 0.3};
  double sim_time = 1.0;
  double sim_granularity = 0.025;
  std::optional<double> angular_sim_granularity;  ///< Absent: as sim_granularity.
  std::optional<double> controller_frequency;
  // Of the code 3; reconfiguration makes 20 of it as the node starts.
  int vx_samples = 20;
  int vtheta_samples = 20;
  bool meter_scoring = false;
  double path_distance_bias = 0.6;
  double goal_distance_bias = 0.8;
  double occdist_scale = 0.01;
  double heading_lookahead = 0.325;
  bool heading_scoring = false;
  double heading_scoring_timestep = 0.8;
  bool dwa = true;
  bool simple_attractor = false;
  bool prune_plan = true;
  bool latch_xy_goal_tolerance = false;
  double oscillation_reset_dist = 0.05;
  double escape_reset_dist = 0.1;
  double escape_reset_theta = 0.25 * kPi;
  double stop_time_buffer = 0.2;
  WorldModel world_model = WorldModel::kCostmap;
  double moving_obstacle_scale = 1.0;
  bool publish_cost_grid_pc = false;

  template <class Archive>
  void visit(Archive& ar) {
    visit_limits(ar);
    visit_simulation(ar);
    visit_scoring(ar);
    visit_escape(ar);
  }

 private:
  template <class Archive>
  void visit_limits(Archive& ar) {
    ar.field("acc_lim_x", acc_lim_x, Range::positive(), "[m/s^2]");
    ar.field("acc_lim_y", acc_lim_y, Range::positive(), "[m/s^2]");
    ar.field("acc_lim_theta", acc_lim_theta, Range::positive(), "[rad/s^2]");
    ar.field("max_vel_x", max_vel_x, Range::positive(), "[m/s]");
    ar.field("min_vel_x", min_vel_x, Range::non_negative(),
             "slower than this the robot does not drive forward, unless it must stop soon [m/s]");
    ar.field("max_vel_theta", max_vel_theta, Range::positive(), "[rad/s]");
    ar.field("min_vel_theta", min_vel_theta, Range{-1e9, 0.0, false, true},
             "the fastest turn to the right [rad/s]");
    ar.field("min_in_place_vel_theta", min_in_place_vel_theta, Range::non_negative(),
             "of turns on the spot [rad/s]");
    ar.field("holonomic_robot", holonomic_robot,
             "it can move sideways; default: as its limits have it");
    ar.field("y_vels", y_vels, "of a holonomic robot that cannot move otherwise [m/s]");
  }
  template <class Archive>
  void visit_simulation(Archive& ar) {
    ar.field("sim_time", sim_time, Range::positive(), "length of trajectories [s]");
    ar.field("sim_granularity", sim_granularity, Range::positive(), "between their points [m]");
    ar.field("angular_sim_granularity", angular_sim_granularity, Range::positive(),
             "between their points; default: as sim_granularity [rad]");
    ar.field("controller_frequency", controller_frequency, Range::positive(),
             "of the caller, which sets the period [Hz]");
    ar.field("vx_samples", vx_samples, Range{1, 1000}, "velocities tried");
    ar.field("vtheta_samples", vtheta_samples, Range{1, 1000}, "velocities tried");
    ar.field("dwa", dwa, "velocities that are reached within a period; else within sim_time");
    ar.field("prune_plan", prune_plan, "the path is cut behind the robot, here always");
    ar.field("world_model", world_model, "what trajectories are compared with");
  }
  template <class Archive>
  void visit_scoring(Archive& ar) {
    ar.field("meter_scoring", meter_scoring, "biases are per meter, not per cell");
    ar.field("path_distance_bias", path_distance_bias, Range::non_negative(), "of the deviation");
    ar.field("goal_distance_bias", goal_distance_bias, Range::non_negative(), "of progress");
    ar.field("occdist_scale", occdist_scale, Range::non_negative(), "of costs");
    ar.field("heading_lookahead", heading_lookahead, Range::non_negative(),
             "ahead of the base, where turns on the spot are scored [m]");
    ar.field("heading_scoring", heading_scoring, "the heading along the path is scored, too");
    ar.field("heading_scoring_timestep", heading_scoring_timestep, Range::positive(),
             "on the trajectory, at which it is [s]");
    ar.field("simple_attractor", simple_attractor,
             "straight to the end of the path ahead, whatever its course");
    ar.field("moving_obstacle_scale", moving_obstacle_scale, Range::non_negative(),
             "of nearness to moving obstacles");
    ar.field("publish_cost_grid_pc", publish_cost_grid_pc, "`cost_cloud` has the scores of cells");
    ar.field("latch_xy_goal_tolerance", latch_xy_goal_tolerance,
             "a position once reached stays so while the robot turns, here always");
  }
  template <class Archive>
  void visit_escape(Archive& ar) {
    ar.field("escape_vel", escape_vel, Range::at_most(0.0),
             "backwards, where no other motion is free of contact [m/s]");
    ar.field("oscillation_reset_dist", oscillation_reset_dist, Range::non_negative(),
             "that must be driven before a turn may change its direction [m]");
    ar.field("escape_reset_dist", escape_reset_dist, Range::non_negative(),
             "that ends an escape [m]");
    ar.field("escape_reset_theta", escape_reset_theta, Range::non_negative(),
             "that ends an escape, and after which a turn may change its direction [rad]");
    ar.field("stop_time_buffer", stop_time_buffer, Range::non_negative(),
             "before a contact; the guard replaces it [s]");
  }
};

}  // namespace trident::nav
