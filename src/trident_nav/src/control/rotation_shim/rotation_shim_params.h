// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "trident_base/config_types.h"

namespace trident::nav {

/// Names and defaults of Nav2's nav2_rotation_shim_controller; the speed and the acceleration of
/// turns without a value are those of the robot's limits.
struct RotationShimParams {
  std::string primary_controller = "regulated_pure_pursuit";
  double angular_dist_threshold = 0.785;
  double angular_disengage_threshold = 0.39;
  double forward_sampling_distance = 0.5;
  std::optional<double> rotate_to_heading_angular_vel;
  std::optional<double> max_angular_accel;
  double simulate_ahead_time = 1.0;
  bool rotate_to_goal_heading = false;
  bool rotate_to_heading_once = false;
  bool closed_loop = true;
  bool use_path_orientations = false;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("primary_controller", primary_controller,
             "the controller that follows the path once the robot faces it; its parameters are "
             "given next to these");
    ar.field("angular_dist_threshold", angular_dist_threshold, Range{0.0, 3.15, true},
             "off the path, from which the robot turns on the spot [rad]");
    ar.field("angular_disengage_threshold", angular_disengage_threshold, Range{0.0, 3.15, true},
             "off the path, at which a turn ends [rad]");
    ar.field("forward_sampling_distance", forward_sampling_distance, Range::positive(),
             "from the robot to the point of the path that it turns to [m]");
    ar.field("rotate_to_heading_angular_vel", rotate_to_heading_angular_vel, Range::positive(),
             "of turns on the spot; default: the robot's limit [rad/s]");
    ar.field("max_angular_accel", max_angular_accel, Range::positive(),
             "of turns on the spot; default: the robot's limit [rad/s^2]");
    ar.field("simulate_ahead_time", simulate_ahead_time, Range::non_negative(),
             "of a turn, which must be free of contact [s]");
    ar.field("rotate_to_goal_heading", rotate_to_goal_heading,
             "turn to the goal's heading once its position is reached, here always");
    ar.field("rotate_to_heading_once", rotate_to_heading_once, "for each goal, not for each path");
    ar.field("closed_loop", closed_loop,
             "turns accelerate from the measured velocity; else from the last command");
    ar.field("use_path_orientations", use_path_orientations,
             "turn to the heading of the path's pose, not toward its position");
  }
  /// Throws Error where a turn would end before it begins.
  void validate() const;
};

}  // namespace trident::nav
