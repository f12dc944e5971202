// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "trident_base/yaml_config.h"
#include "trident_slam/graph_slam_back_end.h"
#include "trident_slam/graph_slam_front_end.h"

namespace trident::slam {

/// What is done with a new scan. `localization` finds its pose in a map that does not change,
/// `lifelong` continues a map and removes scans that newer ones have replaced.
enum class SlamMode { kMapping, kLocalization, kLifelong };

/// Names of the modes in YAML and parameters.
constexpr auto enum_names(SlamMode /*tag*/) {
  return std::array{EnumName<SlamMode>{SlamMode::kMapping, "mapping"},
                    EnumName<SlamMode>{SlamMode::kLocalization, "localization"},
                    EnumName<SlamMode>{SlamMode::kLifelong, "lifelong"}};
}

/// When newer scans replace a scan in lifelong mode; slam_toolbox' names and meaning, with
/// `lifelong_` before them.
struct LifelongOptions {
  /// Compare all older scans near to a new one; false: those that edges lead to.
  bool search_use_tree = true;
  double minimum_score = 0.1;       ///< in [0, 1]
  double iou_match = 0.85;          ///< in [0, 1]
  double node_removal_score = 0.1;  ///< in [0, 1]
  /// What a newer scan that shows all of an older one takes from its score.
  double overlap_score_scale = 0.5;
  double constraint_multiplier = 0.05;  ///< fraction of the score that each edge beyond two returns
  double nearby_penalty = 0.001;        ///< in [0, 1]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("lifelong_search_use_tree", search_use_tree,
             "compare all older scans near to a new one; false: those that edges lead to");
    ar.field("lifelong_minimum_score", minimum_score, Range{0.0, 1.0},
             "bounding boxes must share this fraction (intersection over union) to be compared");
    ar.field("lifelong_iou_match", iou_match, Range{0.0, 1.0},
             "an older scan that shares more, and closes no loop, is removed at once");
    ar.field("lifelong_node_removal_score", node_removal_score, Range{0.0, 1.0},
             "a scan whose score has fallen below is removed");
    ar.field("lifelong_overlap_score_scale", overlap_score_scale, Range{0.0, 10.0},
             "a newer scan that shows all of an older one takes this from its score");
    ar.field("lifelong_constraint_multiplier", constraint_multiplier, Range{0.0, 10.0},
             "fraction of the score that each edge beyond two returns");
    ar.field("lifelong_nearby_penalty", nearby_penalty, Range{0.0, 1.0},
             "a newer scan that is near takes this from the score in any case");
  }
};

/// Parameters of graph_slam_2d. A name that slam_toolbox has, too, means the same.
struct GraphSlamOptions {
  SlamMode mode = SlamMode::kMapping;                      ///< mapping | localization | lifelong
  std::array<double, 3> map_start_pose = {0.0, 0.0, 0.0};  ///< [m], [rad]
  double resolution = 0.05;                                ///< [m]
  double min_laser_range = 0.05;                           ///< [m]
  double max_laser_range = 30.0;                           ///< [m]
  bool use_scan_matching = true;                           ///< false: odometry alone
  /// The default matcher works on the surfaces of the whole map.
  static constexpr char kLinesOfTheMap[] = "point_to_line";
  /// A name of register_builtin_scan_matchers().
  std::string scan_matcher = kLinesOfTheMap;
  double minimum_travel_distance = 0.3;  ///< [m]
  double minimum_travel_heading = 0.3;   ///< [rad]
  /// In kLocalization, recent scans that are matched with where the map ends.
  int scan_buffer_size = 10;
  double scan_buffer_maximum_scan_distance = 10.0;  ///< [m]

  bool do_loop_closing = true;                 ///< look for places that were seen long ago
  double loop_search_maximum_distance = 15.0;  ///< [m]
  /// Of the points that both places can see, the fraction that must agree.
  double loop_match_minimum_response_fine = 0.75;
  int loop_match_minimum_chain_size = 10;  ///< successive keyframes that are compared as one
  double reuse_distance = 60.0;            ///< [m]
  bool is_asynchronous = false;            ///< close loops in a thread of their own
  /// Keep all ranges, so that the end can match each scan with the final map.
  bool keep_scans = true;

  /// False: the motion between scans is measured by the scans alone.
  bool use_odometry = true;
  double odometry_distance_noise = 0.15;  ///< standard deviation of a distance, as a fraction of it
  double odometry_heading_noise = 0.15;   ///< standard deviation of a rotation, as a fraction of it
  double odometry_jump_distance = 3.0;    ///< [m]
  double odometry_jump_heading = 2.5;     ///< [rad]
  /// Predict poses with the errors of odometry corrected that were learnt while driving.
  bool calibrate_odometry = true;
  bool deskew = true;  ///< put each beam where the robot was when it was measured

  LifelongOptions lifelong;   ///< counts in kLifelong only
  FrontEndOptions front_end;  ///< tracking and localization in detail
  BackEndOptions back_end;    ///< pose graph, loops, pruning and editing in detail

  /// Names each field with its range and meaning.
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
             "what places a scan as it comes: a name of register_builtin_scan_matchers");
    ar.field("minimum_travel_distance", minimum_travel_distance, Range{0.01, 10.0},
             "distance after which a scan becomes part of the map [m]");
    ar.field("minimum_travel_heading", minimum_travel_heading, Range{0.01, 3.1},
             "rotation after which a scan becomes part of the map [rad]");
    ar.field("scan_buffer_size", scan_buffer_size, Range{0, 1000},
             "localization: recent scans that are matched with where the map ends");
    ar.field("scan_buffer_maximum_scan_distance", scan_buffer_maximum_scan_distance,
             Range{0.1, 1000.0}, "of those scans, from the newest one [m]");
    visit_loops(ar);
    visit_odometry(ar);
    lifelong.visit(ar);
    ar.field("front_end", front_end, "tracking and localization in detail");
    ar.field("back_end", back_end, "pose graph, loops, pruning and editing in detail");
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
             "of the points that both places can see, the fraction that must agree");
    ar.field("loop_match_minimum_chain_size", loop_match_minimum_chain_size, Range{2, 100},
             "successive keyframes that are compared as one");
    ar.field("reuse_distance", reuse_distance, Range{1.0, 10000.0},
             "old surfaces are matched against as they are if the path to them is shorter [m]");
    ar.field("is_asynchronous", is_asynchronous, "close loops in a thread of their own");
    ar.field("keep_scans", keep_scans,
             "keep all ranges, so that the end can match each scan with the final map; false: "
             "a scan keeps its place at its keyframe");
  }
  template <class Archive>
  void visit_odometry(Archive& ar) {
    ar.field(
        "use_odometry", use_odometry,
        "false: the motion between scans is measured by the scans alone, as it is where odometry "
        "stands still while scans move");
    ar.field("odometry_distance_noise", odometry_distance_noise, Range{0.001, 10.0},
             "standard deviation of a distance, as a fraction of it");
    ar.field("odometry_heading_noise", odometry_heading_noise, Range{0.001, 10.0},
             "standard deviation of a rotation, as a fraction of it");
    ar.field("odometry_jump_distance", odometry_jump_distance, Range{0.1, 1000.0},
             "odometry that moves farther between two scans is rejected [m]");
    ar.field("odometry_jump_heading", odometry_jump_heading, Range{0.1, 3.2},
             "odometry that turns farther between two scans is rejected [rad]");
    ar.field(
        "calibrate_odometry", calibrate_odometry,
        "predict poses by odometry with the errors corrected that were estimated while driving");
    ar.field("deskew", deskew, "put each beam where the robot was when it was measured");
  }
};

}  // namespace trident::slam
