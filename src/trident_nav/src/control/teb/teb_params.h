// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/angle.h"
#include "trident_base/config_types.h"

namespace trident::nav {

enum class TebFootprintType { kPoint, kCircular, kTwoCircles, kLine, kPolygon };
constexpr auto enum_names(TebFootprintType) {
  return std::array{EnumName{TebFootprintType::kPoint, "point"},
                    EnumName{TebFootprintType::kCircular, "circular"},
                    EnumName{TebFootprintType::kTwoCircles, "two_circles"},
                    EnumName{TebFootprintType::kLine, "line"},
                    EnumName{TebFootprintType::kPolygon, "polygon"}};
}

/// Upstream's model of the footprint for the optimization. It is read and then not used: the
/// costmap's footprint is what bands are optimized and checked with, so that the two never differ.
struct TebFootprintModel {
  TebFootprintType type = TebFootprintType::kPoint;
  double radius = 0.2;
  std::array<double, 2> line_start{-0.3, 0.0};
  std::array<double, 2> line_end{0.3, 0.0};
  double front_offset = 0.2, front_radius = 0.2;
  double rear_offset = 0.2, rear_radius = 0.2;
  std::vector<std::array<double, 2>> vertices;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("type", type, "not needed here: the costmap's footprint is used");
    ar.field("radius", radius, Range::non_negative(), "not needed here [m]");
    ar.field("line_start", line_start, Range::any(), "not needed here [m]");
    ar.field("line_end", line_end, Range::any(), "not needed here [m]");
    ar.field("front_offset", front_offset, Range::any(), "not needed here [m]");
    ar.field("front_radius", front_radius, Range::non_negative(), "not needed here [m]");
    ar.field("rear_offset", rear_offset, Range::any(), "not needed here [m]");
    ar.field("rear_radius", rear_radius, Range::non_negative(), "not needed here [m]");
    ar.field("vertices", vertices, Range::any(), "not needed here [m]");
  }
};

/// How costs are weighed against each other.
struct TebWeights {
  double max_vel_x = 2.0, max_vel_y = 2.0, max_vel_theta = 1.0;
  double acc_lim_x = 1.0, acc_lim_y = 1.0, acc_lim_theta = 1.0;
  double kinematics_nh = 1000.0, kinematics_forward_drive = 1.0, kinematics_turning_radius = 1.0;
  double optimaltime = 1.0, shortest_path = 0.0;
  double obstacle = 50.0, inflation = 0.1;
  double dynamic_obstacle = 50.0, dynamic_obstacle_inflation = 0.1;
  double velocity_obstacle_ratio = 0.0;
  double viapoint = 1.0;
  double prefer_rotdir = 50.0;
  double adapt_factor = 2.0;

  template <class Archive>
  void visit(Archive& ar) {
    const Range range = Range::non_negative();
    ar.field("weight_max_vel_x", max_vel_x, range, "of speeds beyond the limit");
    ar.field("weight_max_vel_y", max_vel_y, range, "of speeds beyond the limit");
    ar.field("weight_max_vel_theta", max_vel_theta, range, "of turn rates beyond the limit");
    ar.field("weight_acc_lim_x", acc_lim_x, range, "of accelerations beyond the limit");
    ar.field("weight_acc_lim_y", acc_lim_y, range, "of accelerations beyond the limit");
    ar.field("weight_acc_lim_theta", acc_lim_theta, range, "of accelerations beyond the limit");
    ar.field("weight_kinematics_nh", kinematics_nh, range, "of sideways motion");
    ar.field("weight_kinematics_forward_drive", kinematics_forward_drive, range,
             "of driving backwards");
    ar.field("weight_kinematics_turning_radius", kinematics_turning_radius, range,
             "of turns that are too tight, as a part of weight_kinematics_nh");
    ar.field("weight_optimaltime", optimaltime, range, "of the duration");
    ar.field("weight_shortest_path", shortest_path, range, "of the length");
    ar.field("weight_obstacle", obstacle, range, "of distances below min_obstacle_dist");
    ar.field("weight_inflation", inflation, range, "of distances below inflation_dist");
    ar.field("weight_dynamic_obstacle", dynamic_obstacle, range, "of moving obstacles");
    ar.field("weight_dynamic_obstacle_inflation", dynamic_obstacle_inflation, range,
             "of moving obstacles farther away");
    ar.field("weight_velocity_obstacle_ratio", velocity_obstacle_ratio, range,
             "of speed near obstacles");
    ar.field("weight_viapoint", viapoint, range, "of the distance to points of the path");
    ar.field("weight_prefer_rotdir", prefer_rotdir, range, "not needed here");
    ar.field("weight_adapt_factor", adapt_factor, Range::at_least(1.0),
             "by which the weight of obstacles grows with each outer iteration");
  }
};

/// Names and defaults of teb_local_planner/TebLocalPlannerROS; speeds, accelerations and the
/// turning radius without a value are those of the robot's limits. Keys whose meaning is "not
/// needed here" are those of drawings and of what this implementation does in another path.
struct TebParams {
  // The trajectory.
  std::string odom_topic = "odom", map_frame = "odom";
  bool teb_autosize = true;
  double dt_ref = 0.3, dt_hysteresis = 0.1;
  int min_samples = 3, max_samples = 500;
  bool global_plan_overwrite_orientation = true, allow_init_with_backwards_motion = false;
  double global_plan_viapoint_sep = -1.0;
  bool via_points_ordered = false;
  double max_global_plan_lookahead_dist = 3.0, global_plan_prune_distance = 1.0;
  bool exact_arc_length = false;
  double force_reinit_new_goal_dist = 1.0, force_reinit_new_goal_angular = 0.5 * kPi;
  int feasibility_check_no_poses = 5;
  double feasibility_check_lookahead_distance = -1.0;
  bool publish_feedback = false;
  double min_resolution_collision_check_angular = kPi;
  int control_look_ahead_poses = 1;
  int prevent_look_ahead_poses_near_goal = 0;
  // The robot.
  std::optional<double> max_vel_x, max_vel_x_backwards, max_vel_y, max_vel_trans, max_vel_theta;
  std::optional<double> acc_lim_x, acc_lim_y, acc_lim_theta, min_turning_radius;
  double wheelbase = 1.0;
  bool cmd_angle_instead_rotvel = false, is_footprint_dynamic = false;
  bool use_proportional_saturation = false;
  double transform_tolerance = 0.5;
  TebFootprintModel footprint_model;
  // The goal.
  bool free_goal_vel = false, complete_global_plan = true;
  // Obstacles.
  std::optional<double> min_obstacle_dist, inflation_dist, dynamic_obstacle_inflation_dist;
  bool include_dynamic_obstacles = true, include_costmap_obstacles = true;
  double costmap_obstacles_behind_robot_dist = 1.5;
  int obstacle_poses_affected = 25;
  bool legacy_obstacle_association = false;
  double obstacle_association_force_inclusion_factor = 1.5;
  double obstacle_association_cutoff_factor = 5.0;
  std::string costmap_converter_plugin;
  double costmap_converter_rate = 5.0;
  bool costmap_converter_spin_thread = true;
  double obstacle_proximity_ratio_max_vel = 1.0;
  double obstacle_proximity_lower_bound = 0.0, obstacle_proximity_upper_bound = 0.5;
  // The optimization.
  int no_inner_iterations = 5, no_outer_iterations = 4;
  bool optimization_activate = true, optimization_verbose = false;
  double penalty_epsilon = 0.05;
  double obstacle_cost_exponent = 1.0;
  TebWeights weights;
  // Homotopy classes.
  bool enable_homotopy_class_planning = true, enable_multithreading = true;
  bool simple_exploration = false;
  int max_number_classes = 4, max_number_plans_in_current_class = 1;
  // Upstream's 1 lets equal bands take turns.
  double selection_cost_hysteresis = 0.9, selection_prefer_initial_plan = 0.95;
  double selection_obst_cost_scale = 100.0, selection_viapoint_cost_scale = 1.0;
  bool selection_alternative_time_cost = false;
  double selection_dropping_probability = 0.0, switching_blocking_period = 0.0;
  int roadmap_graph_no_samples = 15;
  double roadmap_graph_area_width = 6.0, roadmap_graph_area_length_scale = 1.0;
  double h_signature_prescaler = 1.0, h_signature_threshold = 0.1;
  double obstacle_keypoint_offset = 0.1, obstacle_heading_threshold = 0.45;
  bool viapoints_all_candidates = true, visualize_hc_graph = false;
  double visualize_with_time_as_z_axis_scale = 0.0;
  bool delete_detours_backwards = true;
  double detours_orientation_tolerance = 0.5 * kPi, length_start_orientation_vector = 0.4;
  double max_ratio_detours_duration_best_duration = 3.0;
  // Recovery.
  bool shrink_horizon_backup = true;
  double shrink_horizon_min_duration = 10.0;
  bool oscillation_recovery = true;
  double oscillation_v_eps = 0.1, oscillation_omega_eps = 0.1;
  double oscillation_recovery_min_duration = 10.0, oscillation_filter_duration = 10.0;
  bool divergence_detection_enable = false;
  double divergence_detection_max_chi_squared = 10.0;

  template <class Archive>
  void visit(Archive& ar) {
    visit_trajectory(ar);
    visit_robot(ar);
    visit_obstacles(ar);
    visit_optimization(ar);
    weights.visit(ar);
    visit_classes(ar);
    visit_selection(ar);
    visit_recovery(ar);
  }

 private:
  template <class Archive>
  void visit_trajectory(Archive& ar) {
    ar.field("odom_topic", odom_topic, "not needed here: move_base subscribes to it");
    ar.field("map_frame", map_frame, "not needed here: the costmap's frame is used");
    ar.field("teb_autosize", teb_autosize, "poses are added and taken away as durations ask for");
    ar.field("dt_ref", dt_ref, Range::positive(), "wanted between poses [s]");
    ar.field("dt_hysteresis", dt_hysteresis, Range::non_negative(), "of that [s]");
    ar.field("min_samples", min_samples, Range::at_least(3), "poses of a band");
    ar.field("max_samples", max_samples, Range::at_least(3), "poses of a band");
    ar.field("global_plan_overwrite_orientation", global_plan_overwrite_orientation,
             "the path's headings before its end are its directions of travel");
    ar.field("allow_init_with_backwards_motion", allow_init_with_backwards_motion,
             "where the path leads behind the robot, the first guess drives there backwards");
    ar.field("global_plan_viapoint_sep", global_plan_viapoint_sep,
             "between points of the path that draw the band; negative: none do [m]");
    ar.field("via_points_ordered", via_points_ordered, "the band reaches them in order");
    ar.field("max_global_plan_lookahead_dist", max_global_plan_lookahead_dist, Range::positive(),
             "of the path that a band covers [m]");
    ar.field("global_plan_prune_distance", global_plan_prune_distance,
             "not needed here: what is passed is cut off [m]");
    ar.field("exact_arc_length", exact_arc_length, "speeds along arcs, not chords");
    ar.field("force_reinit_new_goal_dist", force_reinit_new_goal_dist, Range::positive(),
             "a band whose end moves farther is guessed again [m]");
    ar.field("force_reinit_new_goal_angular", force_reinit_new_goal_angular, Range::positive(),
             "a band whose end turns farther is guessed again [rad]");
    ar.field("feasibility_check_no_poses", feasibility_check_no_poses,
             "poses that must be free of contact, and what is between them; negative: all");
    ar.field("feasibility_check_lookahead_distance", feasibility_check_lookahead_distance,
             "from the robot, beyond which poses are not checked; negative: no limit [m]");
    ar.field("publish_feedback", publish_feedback, "`teb_feedback` is published");
    ar.field("min_resolution_collision_check_angular", min_resolution_collision_check_angular,
             Range::positive(), "between headings that are checked, at most [rad]");
    ar.field("control_look_ahead_poses", control_look_ahead_poses, Range{1, 500},
             "the pose that the command leads to");
    ar.field("prevent_look_ahead_poses_near_goal", prevent_look_ahead_poses_near_goal,
             Range::non_negative(), "so many last poses are not led to at once");
  }
  template <class Archive>
  void visit_robot(Archive& ar) {
    ar.field("max_vel_x", max_vel_x, Range::positive(), "[m/s]");
    ar.field("max_vel_x_backwards", max_vel_x_backwards, Range::non_negative(), "[m/s]");
    ar.field("max_vel_y", max_vel_y, Range::non_negative(), "[m/s]");
    ar.field("max_vel_trans", max_vel_trans, Range::non_negative(), "0: no limit [m/s]");
    ar.field("max_vel_theta", max_vel_theta, Range::positive(), "[rad/s]");
    ar.field("acc_lim_x", acc_lim_x, Range::positive(), "[m/s^2]");
    ar.field("acc_lim_y", acc_lim_y, Range::positive(), "[m/s^2]");
    ar.field("acc_lim_theta", acc_lim_theta, Range::positive(), "[rad/s^2]");
    ar.field("min_turning_radius", min_turning_radius, Range::non_negative(), "[m]");
    ar.field("wheelbase", wheelbase, "not needed here [m]");
    ar.field("cmd_angle_instead_rotvel", cmd_angle_instead_rotvel,
             "not needed here: commands are twists");
    ar.field("is_footprint_dynamic", is_footprint_dynamic,
             "not needed here: the newest footprint is used");
    ar.field("use_proportional_saturation", use_proportional_saturation,
             "not needed here: curvatures are kept within the limits");
    ar.field("transform_tolerance", transform_tolerance, Range::non_negative(), "[s]");
    ar.field("footprint_model", footprint_model, "not needed here");
    ar.field("free_goal_vel", free_goal_vel, "the robot need not stop at the goal");
    ar.field("complete_global_plan", complete_global_plan,
             "not needed here: paths that cross themselves are driven to their end");
  }
  template <class Archive>
  void visit_obstacles(Archive& ar) {
    ar.field("min_obstacle_dist", min_obstacle_dist, Range::non_negative(),
             "that the footprint keeps where there is room; default: the inscribed radius, at most "
             "0.5 [m]");
    ar.field("inflation_dist", inflation_dist, Range::non_negative(),
             "up to which obstacles count a little; default: 0.1 more [m]");
    ar.field("dynamic_obstacle_inflation_dist", dynamic_obstacle_inflation_dist,
             Range::non_negative(), "the same of moving ones [m]");
    ar.field("include_dynamic_obstacles", include_dynamic_obstacles,
             "moving obstacles count where they will be");
    ar.field("include_costmap_obstacles", include_costmap_obstacles, "the costmap's cells count");
    ar.field("costmap_obstacles_behind_robot_dist", costmap_obstacles_behind_robot_dist,
             Range::non_negative(), "cells farther behind do not count [m]");
    ar.field("obstacle_poses_affected", obstacle_poses_affected, "not needed here");
    ar.field("legacy_obstacle_association", legacy_obstacle_association, "not needed here");
    ar.field("obstacle_association_force_inclusion_factor",
             obstacle_association_force_inclusion_factor, "not needed here");
    ar.field("obstacle_association_cutoff_factor", obstacle_association_cutoff_factor,
             "not needed here");
    ar.field("costmap_converter_plugin", costmap_converter_plugin,
             "not needed here: cells are few enough");
    ar.field("costmap_converter_rate", costmap_converter_rate, "not needed here [Hz]");
    ar.field("costmap_converter_spin_thread", costmap_converter_spin_thread, "not needed here");
    ar.field("obstacle_proximity_ratio_max_vel", obstacle_proximity_ratio_max_vel, Range{0.0, 1.0},
             "of the speed at the lower bound");
    ar.field("obstacle_proximity_lower_bound", obstacle_proximity_lower_bound,
             Range::non_negative(), "[m]");
    ar.field("obstacle_proximity_upper_bound", obstacle_proximity_upper_bound,
             Range::non_negative(), "distance from which the full speed is allowed [m]");
  }
  template <class Archive>
  void visit_optimization(Archive& ar) {
    ar.field("no_inner_iterations", no_inner_iterations, Range{1, 100},
             "with the same poses and obstacles");
    ar.field("no_outer_iterations", no_outer_iterations, Range{1, 100},
             "each with a new choice of poses and obstacles");
    ar.field("optimization_activate", optimization_activate, "else bands stay as guessed");
    ar.field("optimization_verbose", optimization_verbose, "not needed here");
    ar.field("penalty_epsilon", penalty_epsilon, Range::non_negative(),
             "margin that limits and distances are kept with");
    ar.field("obstacle_cost_exponent", obstacle_cost_exponent, Range::positive(),
             "of what lacks of the distance");
  }
  template <class Archive>
  void visit_classes(Archive& ar) {
    ar.field("enable_homotopy_class_planning", enable_homotopy_class_planning,
             "bands around obstacles on other sides are optimized, too");
    ar.field("enable_multithreading", enable_multithreading, "not needed here");
    ar.field("simple_exploration", simple_exploration, "not needed here");
    ar.field("max_number_classes", max_number_classes, Range{1, 32}, "bands that are optimized");
    ar.field("max_number_plans_in_current_class", max_number_plans_in_current_class,
             "not needed here: one");
    ar.field("roadmap_graph_no_samples", roadmap_graph_no_samples,
             "not needed here: other classes are searched on a lattice");
    ar.field("roadmap_graph_area_width", roadmap_graph_area_width, Range::positive(),
             "in which other classes are searched [m]");
    ar.field("roadmap_graph_area_length_scale", roadmap_graph_area_length_scale, Range::positive(),
             "of the area's length to the distance of the goal");
    ar.field("h_signature_prescaler", h_signature_prescaler,
             "not needed here: signatures are whole numbers");
    ar.field("h_signature_threshold", h_signature_threshold, "not needed here");
    ar.field("obstacle_keypoint_offset", obstacle_keypoint_offset, "not needed here [m]");
    ar.field("obstacle_heading_threshold", obstacle_heading_threshold, "not needed here");
    ar.field("viapoints_all_candidates", viapoints_all_candidates,
             "else points of the path draw only the bands that pass obstacles as it does");
    ar.field("visualize_hc_graph", visualize_hc_graph, "not needed here");
    ar.field("visualize_with_time_as_z_axis_scale", visualize_with_time_as_z_axis_scale,
             "not needed here");
  }
  template <class Archive>
  void visit_selection(Archive& ar) {
    ar.field("selection_cost_hysteresis", selection_cost_hysteresis, Range{0.0, 1.0, true},
             "another band must cost less than this times the present one");
    ar.field("selection_prefer_initial_plan", selection_prefer_initial_plan, Range{0.0, 1.0, true},
             "factor of the cost of the band that passes obstacles as the path does");
    ar.field("selection_obst_cost_scale", selection_obst_cost_scale, Range::non_negative(),
             "of obstacles, when bands are compared");
    ar.field("selection_viapoint_cost_scale", selection_viapoint_cost_scale, Range::non_negative(),
             "of points of the path, when bands are compared");
    ar.field("selection_alternative_time_cost", selection_alternative_time_cost,
             "the duration replaces the optimized cost of time");
    ar.field("selection_dropping_probability", selection_dropping_probability,
             "not needed here: two runs are equal");
    ar.field("switching_blocking_period", switching_blocking_period, Range::non_negative(),
             "without another change of the class [s]");
    ar.field("delete_detours_backwards", delete_detours_backwards,
             "bands that begin backwards are left out where another does not");
    ar.field("detours_orientation_tolerance", detours_orientation_tolerance, Range::positive(),
             "from the best band's first direction [rad]");
    ar.field("length_start_orientation_vector", length_start_orientation_vector, Range::positive(),
             "of that first direction [m]");
    ar.field("max_ratio_detours_duration_best_duration", max_ratio_detours_duration_best_duration,
             Range::at_least(1.0), "longer bands are left out");
  }
  template <class Archive>
  void visit_recovery(Archive& ar) {
    ar.field("shrink_horizon_backup", shrink_horizon_backup,
             "where no band is free, bands get shorter for a while");
    ar.field("shrink_horizon_min_duration", shrink_horizon_min_duration, Range::non_negative(),
             "how long [s]");
    ar.field("oscillation_recovery", oscillation_recovery, "not needed here");
    ar.field("oscillation_v_eps", oscillation_v_eps, "not needed here");
    ar.field("oscillation_omega_eps", oscillation_omega_eps, "not needed here");
    ar.field("oscillation_recovery_min_duration", oscillation_recovery_min_duration,
             "not needed here [s]");
    ar.field("oscillation_filter_duration", oscillation_filter_duration, "not needed here [s]");
    ar.field("divergence_detection_enable", divergence_detection_enable,
             "not needed here: steps that make it worse are never taken");
    ar.field("divergence_detection_max_chi_squared", divergence_detection_max_chi_squared,
             "not needed here");
  }
};

}  // namespace trident::nav
