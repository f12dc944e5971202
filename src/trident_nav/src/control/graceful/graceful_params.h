// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "trident_base/config_types.h"

namespace trident::nav {

/// Names and defaults of Nav2's nav2_graceful_controller; speeds without a value are those of the
/// robot's limits.
struct GracefulParams {
  double min_lookahead = 0.25;
  double max_lookahead = 1.0;
  double k_phi = 2.0;
  double k_delta = 1.0;
  double beta = 0.4;
  double lambda = 2.0;
  double v_linear_min = 0.1;
  std::optional<double> v_linear_max;
  std::optional<double> v_angular_max;
  double v_angular_min_in_place = 0.25;
  double slowdown_radius = 1.5;
  bool initial_rotation = true;
  double initial_rotation_tolerance = 0.75;
  bool prefer_final_rotation = true;
  double rotation_scaling_factor = 0.5;
  bool allow_backward = false;
  double in_place_collision_resolution = 0.1;
  bool use_collision_detection = true;
  std::optional<double> max_robot_pose_search_dist;

  template <class Archive>
  void visit(Archive& ar) {
    visit_law(ar);
    visit_speeds(ar);
    visit_turning(ar);
    ar.field("allow_backward", allow_backward, "poses behind the robot are reached backwards");
    ar.field("use_collision_detection", use_collision_detection,
             "the pose to reach is one to which the law's motion is free of contact");
    ar.field("max_robot_pose_search_dist", max_robot_pose_search_dist,
             Range::positive().or_infinite(), "along the path, for the nearest point [m]");
  }
  /// Throws Error where the lookahead distances contradict each other.
  void validate() const;

 private:
  template <class Archive>
  void visit_law(Archive& ar) {
    ar.field("min_lookahead", min_lookahead, Range::positive(),
             "to the nearest pose of the path that is tried [m]");
    ar.field("max_lookahead", max_lookahead, Range::positive(), "to the farthest one [m]");
    ar.field("k_phi", k_phi, Range::non_negative(),
             "how fast the heading turns to that of the pose");
    ar.field("k_delta", k_delta, Range::positive(), "how fast the robot's heading follows");
    ar.field("beta", beta, Range::non_negative(), "of the loss of speed by curvature");
    ar.field("lambda", lambda, Range::positive(), "power of the curvature in that loss");
  }
  template <class Archive>
  void visit_speeds(Archive& ar) {
    ar.field("v_linear_min", v_linear_min, Range::non_negative(), "[m/s]");
    ar.field("v_linear_max", v_linear_max, Range::positive(), "default: the robot's limit [m/s]");
    ar.field("v_angular_max", v_angular_max, Range::positive(),
             "default: the robot's limit [rad/s]");
    ar.field("slowdown_radius", slowdown_radius, Range::positive(),
             "about the goal, in which the speed falls [m]");
  }
  template <class Archive>
  void visit_turning(Archive& ar) {
    ar.field("v_angular_min_in_place", v_angular_min_in_place, Range::non_negative(),
             "of turns on the spot [rad/s]");
    ar.field("initial_rotation", initial_rotation,
             "turn on the spot where the pose to reach is off by more than the tolerance below");
    ar.field("initial_rotation_tolerance", initial_rotation_tolerance, Range{0.0, 3.15, true},
             "[rad]");
    ar.field("prefer_final_rotation", prefer_final_rotation,
             "arrive along the path and turn there; else arrive with the goal's heading");
    ar.field("rotation_scaling_factor", rotation_scaling_factor, Range::positive(),
             "of the angle that is left to the speed of turns on the spot [1/rad]");
    ar.field("in_place_collision_resolution", in_place_collision_resolution, Range::positive(),
             "between the headings of a turn that are checked [rad]");
  }
};

}  // namespace trident::nav
