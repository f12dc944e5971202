// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_base/config_types.h"
#include "trident_nav/core/cost_grid.h"

namespace trident::nav {

/// Parameters of one costmap but for its layers, under the names and with the defaults of
/// costmap_2d; keys of Nav2 are translated before they get here (costmap_config.h).
struct CostmapParams {
  std::string global_frame = "map";
  std::string robot_base_frame = "base_link";
  bool rolling_window = false;
  bool track_unknown_space = false;
  bool always_send_full_costmap = false;
  double update_frequency = 5.0;
  double publish_frequency = 0.0;
  double transform_tolerance = 0.3;
  double width = 10.0;
  double height = 10.0;
  double resolution = 0.05;
  double origin_x = 0.0;
  double origin_y = 0.0;
  std::string footprint;
  double robot_radius = 0.46;
  double footprint_padding = 0.01;
  std::string footprint_topic = "footprint";
  std::string published_footprint_topic = "footprint";  // as in Noetic

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("global_frame", global_frame, "frame of the costmap");
    ar.field("robot_base_frame", robot_base_frame, "frame of the robot's base");
    ar.field("rolling_window", rolling_window, "the map stays centered about the robot");
    ar.field("track_unknown_space", track_unknown_space, "cells begin as unknown, not as free");
    ar.field("always_send_full_costmap", always_send_full_costmap,
             "publish all cells each time, not what changed");
    ar.field("update_frequency", update_frequency, Range::non_negative(), "of the map [Hz]");
    ar.field("publish_frequency", publish_frequency, Range::non_negative(), "0: never [Hz]");
    ar.field("transform_tolerance", transform_tolerance, Range::non_negative(),
             "how old the robot's pose may be [s]");
    ar.field("width", width, Range::positive(), "[m]");
    ar.field("height", height, Range::positive(), "[m]");
    ar.field("resolution", resolution, Range::positive(), "side of a cell [m]");
    ar.field("origin_x", origin_x, "of the lower left corner [m]");
    ar.field("origin_y", origin_y, "of the lower left corner [m]");
    ar.field("footprint", footprint, "corners as text [[x, y], ...]; empty: a circle [m]");
    ar.field("robot_radius", robot_radius, Range::positive(), "when there is no footprint [m]");
    ar.field("footprint_padding", footprint_padding, "added to the footprint on all sides [m]");
    ar.field("footprint_topic", footprint_topic, "topic from which footprints are taken");
    ar.field("published_footprint_topic", published_footprint_topic,
             "topic of the footprint at the robot's pose");
  }
  /// Throws Error when the grid would have no cell or more than 2^30, or the footprint is not one.
  void validate() const;

  /// Where the grid lies at first.
  GridGeometry geometry() const;
  /// The footprint with its padding. Throws Error as polygon_footprint() does.
  Footprint padded_footprint() const;
};

}  // namespace trident::nav
