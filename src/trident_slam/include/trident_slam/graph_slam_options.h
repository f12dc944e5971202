// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "trident_base/yaml_config.h"

namespace trident {

/// What is done with a new scan. `localization` finds its place in a map that does not change,
/// `lifelong` goes on with a map and lets go of scans that newer ones have replaced.
enum class SlamMode { kMapping, kLocalization, kLifelong };

constexpr auto enum_names(SlamMode /*tag*/) {
  return std::array{EnumName<SlamMode>{SlamMode::kMapping, "mapping"},
                    EnumName<SlamMode>{SlamMode::kLocalization, "localization"},
                    EnumName<SlamMode>{SlamMode::kLifelong, "lifelong"}};
}

/// Parameters of graph_slam_2d. A name that slam_toolbox has, too, means the same.
struct GraphSlamOptions {
  SlamMode mode = SlamMode::kMapping;
  std::array<double, 3> map_start_pose = {0.0, 0.0, 0.0};
  double resolution = 0.05;
  double min_laser_range = 0.05;
  double max_laser_range = 30.0;
  bool use_scan_matching = true;
  /// The default matcher works on the surfaces of the whole map.
  static constexpr char kLinesOfTheMap[] = "point_to_line";
  std::string scan_matcher = kLinesOfTheMap;
  double minimum_travel_distance = 0.3;
  double minimum_travel_heading = 0.3;

  bool do_loop_closing = true;
  double loop_search_maximum_distance = 15.0;
  double loop_match_minimum_response_fine = 0.75;
  int loop_match_minimum_chain_size = 10;
  double reuse_distance = 60.0;
  bool is_asynchronous = false;

  double odometry_distance_noise = 0.15;
  double odometry_heading_noise = 0.15;
  double odometry_jump_distance = 3.0;
  double odometry_jump_heading = 2.5;
  bool calibrate_odometry = false;
  bool deskew = true;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("mode", mode, "mapping | localization | lifelong");
    ar.field("map_start_pose", map_start_pose, Range::any(),
             "of the first scan: x, y [m], yaw [rad]");
    ar.field("resolution", resolution, Range{0.005, 1.0}, "side of a cell of the map [m]");
    ar.field("min_laser_range", min_laser_range, Range::non_negative(),
             "nearer returns are not used [m]");
    ar.field("max_laser_range", max_laser_range, Range{0.5, 1000.0},
             "farther returns are not used [m]");
    ar.field("use_scan_matching", use_scan_matching, "false: odometry alone");
    ar.field("scan_matcher", scan_matcher,
             "correlative | grid_gauss_newton | hybrid | ndt | point_to_line");
    ar.field("minimum_travel_distance", minimum_travel_distance, Range{0.01, 10.0},
             "way after which a scan becomes part of the map [m]");
    ar.field("minimum_travel_heading", minimum_travel_heading, Range{0.01, 3.1},
             "turn after which a scan becomes part of the map [rad]");
    visit_loops(ar);
    visit_odometry(ar);
  }
  /// Throws Error naming field, value and range.
  void validate() const;

 private:
  template <class Archive>
  void visit_loops(Archive& ar) {
    ar.field("do_loop_closing", do_loop_closing, "look for places that were seen long ago");
    ar.field("loop_search_maximum_distance", loop_search_maximum_distance, Range{0.5, 200.0},
             "a loop may have drifted apart by this [m]");
    ar.field("loop_match_minimum_response_fine", loop_match_minimum_response_fine, Range{0.1, 1.0},
             "of the points that both places can see, the part that must agree");
    ar.field("loop_match_minimum_chain_size", loop_match_minimum_chain_size, Range{2, 100},
             "successive keyframes that are compared as one");
    ar.field("reuse_distance", reuse_distance, Range{1.0, 10000.0},
             "old surfaces are matched against as they are if the way to them is shorter [m]");
    ar.field("is_asynchronous", is_asynchronous, "close loops in a thread of their own");
  }
  template <class Archive>
  void visit_odometry(Archive& ar) {
    ar.field("odometry_distance_noise", odometry_distance_noise, Range{0.001, 10.0},
             "standard deviation of a distance, as a part of it");
    ar.field("odometry_heading_noise", odometry_heading_noise, Range{0.001, 10.0},
             "standard deviation of a turn, as a part of it");
    ar.field("odometry_jump_distance", odometry_jump_distance, Range{0.1, 1000.0},
             "odometry that moves farther between two scans is not believed [m]");
    ar.field("odometry_jump_heading", odometry_jump_heading, Range{0.1, 3.2},
             "odometry that turns farther between two scans is not believed [rad]");
    ar.field("calibrate_odometry", calibrate_odometry,
             "predict poses by odometry with the errors corrected that were learnt while driving");
    ar.field("deskew", deskew, "put each beam where the robot was when it was measured");
  }
};

}  // namespace trident
