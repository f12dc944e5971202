// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "trident_base/config_types.h"

namespace trident::nav {

/// Names and defaults of Nav2's nav2_regulated_pure_pursuit_controller; speeds without a value are
/// those of the robot's limits.
struct PurePursuitParams {
  std::optional<double> desired_linear_vel;
  double lookahead_dist = 0.6;
  double min_lookahead_dist = 0.3;
  double max_lookahead_dist = 0.9;
  double lookahead_time = 1.5;
  bool use_velocity_scaled_lookahead_dist = false;
  std::optional<double> rotate_to_heading_angular_vel;
  std::optional<double> max_angular_accel;
  bool use_rotate_to_heading = true;
  double rotate_to_heading_min_angle = 0.785;
  double min_approach_linear_velocity = 0.05;
  double approach_velocity_scaling_dist = 0.6;
  double max_allowed_time_to_collision_up_to_carrot = 1.0;
  bool use_collision_detection = true;
  bool use_regulated_linear_velocity_scaling = true;
  bool use_cost_regulated_linear_velocity_scaling = true;
  double cost_scaling_dist = 0.6;
  double cost_scaling_gain = 1.0;
  double inflation_cost_scaling_factor = 3.0;
  double regulated_linear_scaling_min_radius = 0.9;
  double regulated_linear_scaling_min_speed = 0.25;
  bool use_fixed_curvature_lookahead = false;
  double curvature_lookahead_dist = 0.6;
  bool allow_reversing = false;
  bool use_cancel_deceleration = false;
  double cancel_deceleration = 3.2;
  bool interpolate_curvature_after_goal = false;
  bool stateful = true;
  std::optional<double> max_robot_pose_search_dist;

  template <class Archive>
  void visit(Archive& ar) {
    visit_lookahead(ar);
    visit_turning(ar);
    visit_regulation(ar);
    ar.field("use_collision_detection", use_collision_detection,
             "the arc to the carrot must be free for the time below");
    ar.field("max_allowed_time_to_collision_up_to_carrot",
             max_allowed_time_to_collision_up_to_carrot, Range::non_negative(), "[s]");
    ar.field("use_cancel_deceleration", use_cancel_deceleration, "brake gently when canceled");
    ar.field("cancel_deceleration", cancel_deceleration, Range::positive(), "[m/s^2]");
    ar.field("stateful", stateful, "a position once reached stays so while the robot turns");
    ar.field("max_robot_pose_search_dist", max_robot_pose_search_dist,
             Range::positive().or_infinite(), "along the path, for the nearest point [m]");
  }
  /// Throws Error where the lookahead distances contradict each other.
  void validate() const;

 private:
  template <class Archive>
  void visit_lookahead(Archive& ar) {
    ar.field("lookahead_dist", lookahead_dist, Range::positive(), "to the carrot [m]");
    ar.field("min_lookahead_dist", min_lookahead_dist, Range::positive(), "[m]");
    ar.field("max_lookahead_dist", max_lookahead_dist, Range::positive(), "[m]");
    ar.field("lookahead_time", lookahead_time, Range::positive(),
             "of the distance at the present speed [s]");
    ar.field("use_velocity_scaled_lookahead_dist", use_velocity_scaled_lookahead_dist,
             "the lookahead is speed times lookahead_time");
    ar.field("use_fixed_curvature_lookahead", use_fixed_curvature_lookahead,
             "the curvature that regulates the speed is taken at a distance of its own");
    ar.field("curvature_lookahead_dist", curvature_lookahead_dist, Range::positive(), "[m]");
    ar.field("interpolate_curvature_after_goal", interpolate_curvature_after_goal,
             "the path is continued straight beyond the goal for the curvature's lookahead");
  }
  template <class Archive>
  void visit_turning(Archive& ar) {
    ar.field("rotate_to_heading_angular_vel", rotate_to_heading_angular_vel, Range::positive(),
             "of turns on the spot; default: the robot's limit [rad/s]");
    ar.field("max_angular_accel", max_angular_accel, Range::positive(),
             "of turns on the spot; default: the robot's limit [rad/s^2]");
    ar.field("use_rotate_to_heading", use_rotate_to_heading,
             "turn on the spot where the path leads off by more than the angle below");
    ar.field("rotate_to_heading_min_angle", rotate_to_heading_min_angle, Range{0.0, 3.15}, "[rad]");
    ar.field("allow_reversing", allow_reversing,
             "parts of the path whose headings oppose it are driven backwards");
  }
  template <class Archive>
  void visit_regulation(Archive& ar) {
    ar.field("desired_linear_vel", desired_linear_vel, Range::positive(),
             "default: the robot's limit [m/s]");
    ar.field("min_approach_linear_velocity", min_approach_linear_velocity, Range::positive(),
             "near the goal [m/s]");
    ar.field("approach_velocity_scaling_dist", approach_velocity_scaling_dist,
             Range::non_negative(), "from the goal, where the speed falls [m]");
    ar.field("use_regulated_linear_velocity_scaling", use_regulated_linear_velocity_scaling,
             "slower in curves");
    ar.field("use_cost_regulated_linear_velocity_scaling",
             use_cost_regulated_linear_velocity_scaling, "slower near obstacles");
    ar.field("cost_scaling_dist", cost_scaling_dist, Range::positive(),
             "from obstacles, where the speed falls [m]");
    ar.field("cost_scaling_gain", cost_scaling_gain, Range{0.0, 1.0, true}, "on that speed");
    ar.field("inflation_cost_scaling_factor", inflation_cost_scaling_factor, Range::positive(),
             "of the costmap's inflation, where it has no distances [1/m]");
    ar.field("regulated_linear_scaling_min_radius", regulated_linear_scaling_min_radius,
             Range::positive(), "narrower curves are driven slower [m]");
    ar.field("regulated_linear_scaling_min_speed", regulated_linear_scaling_min_speed,
             Range::positive(), "regulation leaves at least this [m/s]");
  }
};

}  // namespace trident::nav
