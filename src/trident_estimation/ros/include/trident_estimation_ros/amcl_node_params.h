// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_base/config_types.h"
#include "trident_estimation/amcl_params.h"

namespace trident::estimation {

/// The private parameters of the node, under amcl's names. What `Amcl` itself needs is in `filter`.
struct AmclNodeParams {
  AmclParams filter;                        ///< what the filter itself needs
  std::string odom_frame_id = "odom";       ///< frame of odometry
  std::string base_frame_id = "base_link";  ///< frame of the robot
  std::string global_frame_id = "map";      ///< frame of the map
  double transform_tolerance = 0.1;         ///< [s]
  bool tf_broadcast = true;                 ///< whether map -> odom is published
  bool use_map_topic = false;               ///< map from the topic, not the service static_map
  bool first_map_only = false;              ///< use_map_topic: pass over later maps
  double initial_pose_x = 0.0, initial_pose_y = 0.0, initial_pose_a = 0.0;  ///< [m]
  double initial_cov_xx = 0.25, initial_cov_yy = 0.25,
         initial_cov_aa = 0.068538919;  ///< [m^2], [rad^2]
  double save_pose_rate = 0.5;          ///< [Hz]
  double gui_publish_rate = -1.0;       ///< [Hz]
  double std_warn_level_x = 0.2, std_warn_level_y = 0.2, std_warn_level_yaw = 0.1;  ///< [m]
  double bag_loop_jump = 1.0;                                                       ///< [s]
  bool start_anywhere = false;  ///< as if global_localization were called when there is a map

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    filter.visit(ar);
    ar.field("odom_frame_id", odom_frame_id, "frame of odometry");
    ar.field("base_frame_id", base_frame_id, "frame of the robot");
    ar.field("global_frame_id", global_frame_id, "frame of the map");
    ar.field("transform_tolerance", transform_tolerance, Range::non_negative(),
             "how far ahead of the scan map -> odom is stamped [s]");
    ar.field("tf_broadcast", tf_broadcast, "whether map -> odom is published");
    ar.field("use_map_topic", use_map_topic, "map from the topic, not the service static_map");
    ar.field("first_map_only", first_map_only, "use_map_topic: pass over later maps");
    ar.field("initial_pose_x", initial_pose_x, Range::any(), "mean at the start [m]");
    ar.field("initial_pose_y", initial_pose_y, Range::any(), "mean at the start [m]");
    ar.field("initial_pose_a", initial_pose_a, Range::any(), "mean at the start [rad]");
    ar.field("initial_cov_xx", initial_cov_xx, Range::non_negative(), "at the start [m^2]");
    ar.field("initial_cov_yy", initial_cov_yy, Range::non_negative(), "at the start [m^2]");
    ar.field("initial_cov_aa", initial_cov_aa, Range::non_negative(), "at the start [rad^2]");
    ar.field("save_pose_rate", save_pose_rate, Range::at_least(-1.0),
             "of writing the pose to initial_pose_* and initial_cov_*; <= 0: never [Hz]");
    ar.field("gui_publish_rate", gui_publish_rate, Range::at_least(-1.0),
             "most particle clouds published; <= 0: one per resampling [Hz]");
    ar.field("std_warn_level_x", std_warn_level_x, Range::non_negative(), "for diagnostics [m]");
    ar.field("std_warn_level_y", std_warn_level_y, Range::non_negative(), "for diagnostics [m]");
    ar.field("std_warn_level_yaw", std_warn_level_yaw, Range::non_negative(),
             "for diagnostics [rad]");
    ar.field("bag_loop_jump", bag_loop_jump, Range::positive(),
             "a jump back of stamps by more is a bag that begins again [s]");
    ar.field("start_anywhere", start_anywhere,
             "as if global_localization were called when there is a map");
  }
  /// Throws Error when fields contradict one another.
  void validate() const { filter.validate(); }
};

}  // namespace trident::estimation
