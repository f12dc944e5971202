// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/yaml_config.h"

namespace trident::slam {

/// How uncertain odometry is taken to be per motion between two scans, in addition to
/// `odometry_distance_noise` and `odometry_heading_noise` (standard deviations). The form, floors
/// plus fractions of distance and rotation, is that of S. Thrun et al., "Probabilistic Robotics",
/// 2005, section 5.4.
struct OdometryNoiseOptions {
  double distance_floor = 0.01;       ///< [m]
  double distance_per_radian = 0.05;  ///< [m/rad]
  double yaw_floor = 0.005;           ///< [rad]
  double yaw_per_meter = 0.03;        ///< [rad/m]
  double problem_distance = 0.5;      ///< [m]
  double problem_yaw = 0.25;          ///< [rad]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("distance_floor", distance_floor, Range{1e-6, 10.0}, "of a motion of any length [m]");
    ar.field("distance_per_radian", distance_per_radian, Range{0.0, 10.0},
             "position error per rotation [m/rad]");
    ar.field("yaw_floor", yaw_floor, Range{1e-6, 3.2},
             "of the heading after a motion of any length [rad]");
    ar.field("yaw_per_metre", yaw_per_meter, Range{0.0, 10.0},
             "heading error per distance [rad/m]");
    ar.field("problem_distance", problem_distance, Range{0.0, 100.0},
             "added where odometry reports an impossible motion [m]");
    ar.field("problem_yaw", problem_yaw, Range{0.0, 3.2}, "the same for the heading [rad]");
  }
};

/// When a scan's match with the local map is accepted, and when its pose is searched for in a
/// window instead. A match is scored by its inlier fraction minus `prior_weight` d / (d +
/// `max_squared_deviation`), d being its squared Mahalanobis distance from the prediction.
struct TrackingOptions {
  double surfel_cell = 0.1;           ///< [m]
  double min_inliers = 0.6;           ///< in [0, 1]
  double min_inliers_by_scans = 0.8;  ///< in [0, 1]
  double lost_inliers = 0.5;          ///< in [0, 1]
  double search_motion = 0.3;         ///< [m]
  double search_turn = 0.3;           ///< [rad]
  double prior_sigmas = 3.0;          ///< [standard deviations]
  double search_gain = 0.05;          ///< in [0, 1]
  double prior_weight = 0.35;         ///< in [0, 1]
  /// Squared deviation from the prediction at which half of `prior_weight` counts.
  double max_squared_deviation = 9.0;
  double min_lost_inliers = 0.7;           ///< in [0, 1]
  double inconsistent_inliers = 0.8;       ///< in [0, 1]
  double min_inconsistent_inliers = 0.95;  ///< in [0, 1]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("surfel_cell", surfel_cell, Range{0.01, 1.0},
             "side of a cell of the surfaces that scans are matched with [m]");
    ar.field("min_inliers", min_inliers, Range{0.0, 1.0},
             "a smaller fraction of points on surfaces starts a search in the near window");
    ar.field("min_inliers_by_scans", min_inliers_by_scans, Range{0.0, 1.0},
             "the same where scans alone measure the motion");
    ar.field("lost_inliers", lost_inliers, Range{0.0, 1.0},
             "a smaller fraction starts a search in the wide window");
    ar.field("search_motion", search_motion, Range{0.0, 1000.0},
             "a longer motion between two scans starts a search [m]");
    ar.field("search_turn", search_turn, Range{0.0, 3.2},
             "a larger rotation between two scans starts a search [rad]");
    ar.field("prior_sigmas", prior_sigmas, Range{0.1, 100.0},
             "a match farther from the prediction is checked by a search [standard deviations]");
    ar.field("search_gain", search_gain, Range{0.0, 1.0},
             "score by which a pose from a search must be better than the one at hand");
    ar.field("prior_weight", prior_weight, Range{0.0, 1.0},
             "inlier fraction that a pose excluded by odometry must make up for");
    ar.field("max_squared_deviation", max_squared_deviation, Range{0.01, 10000.0},
             "squared deviation from the prediction at which half of `prior_weight` counts");
    ar.field("min_lost_inliers", min_lost_inliers, Range{0.0, 1.0},
             "fraction that must fit in a pose of the wide window where hardly any pose did");
    ar.field("inconsistent_inliers", inconsistent_inliers, Range{0.0, 1.0},
             "a smaller fraction at a pose that odometry excludes is inconsistent");
    ar.field("min_inconsistent_inliers", min_inconsistent_inliers, Range{0.0, 1.0},
             "fraction that must fit in a pose that replaces an inconsistent one");
  }
};

/// The correlative search about the predicted pose.
/// E. Olson, "Real-time correlative scan matching", ICRA 2009; W. Hess et al., "Real-time loop
/// closure in 2D LIDAR SLAM", ICRA 2016 (branch and bound).
struct TrackingSearchOptions {
  double resolution = 0.05;        ///< [m]
  int levels = 4;                  ///< levels of the pyramid
  int max_points = 200;            ///< points of a scan that are used
  double min_response = 0.2;       ///< in [0, 1]
  double reach = 12.0;             ///< [m]
  double max_distance = 3.0;       ///< [m]
  int max_changes = 5;             ///< the pyramid is rebuilt after so many keyframes
  double near_window = 0.2;        ///< [m]
  double near_window_yaw = 0.05;   ///< [rad]
  double window_sigmas = 3.0;      ///< standard deviations of the position that are added to it
  double window_sigmas_yaw = 2.0;  ///< standard deviations of the heading that are added to it
  double wide_window = 1.0;        ///< [m]
  double wide_window_yaw = 0.8;    ///< [rad]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("resolution", resolution, Range{0.005, 1.0}, "side of the finest cell [m]");
    ar.field("levels", levels, Range{1, 12}, "levels of the pyramid");
    ar.field("max_points", max_points, Range{10, 100000}, "points of a scan that are used");
    ar.field("min_response", min_response, Range{0.0, 1.0},
             "fraction of the points that must hit surfaces");
    ar.field("reach", reach, Range{1.0, 1000.0},
             "surfaces within this of the robot are searched [m]");
    ar.field("max_distance", max_distance, Range{0.0, 1000.0},
             "the pyramid is rebuilt when the robot is farther from its center [m]");
    ar.field("max_changes", max_changes, Range{1, 1000},
             "the pyramid is rebuilt after so many keyframes");
    ar.field("near_window", near_window, Range{0.0, 100.0},
             "half side of the near window without odometry noise [m]");
    ar.field("near_window_yaw", near_window_yaw, Range{0.0, 3.2}, "the same for the heading [rad]");
    ar.field("window_sigmas", window_sigmas, Range{0.0, 100.0},
             "standard deviations of the position that are added to it");
    ar.field("window_sigmas_yaw", window_sigmas_yaw, Range{0.0, 100.0},
             "standard deviations of the heading that are added to it");
    ar.field("wide_window", wide_window, Range{0.0, 100.0},
             "the wide window exceeds the near one by this [m]");
    ar.field("wide_window_yaw", wide_window_yaw, Range{0.0, 3.2}, "the same for the heading [rad]");
  }
};

/// From which matches the errors of odometry are learnt. Model: A. Censi et al., "Simultaneous
/// calibration of odometry and sensor parameters for mobile robots", T-RO 29(2), 2013.
struct CalibrationOptions {
  double min_inliers = 0.6;      ///< in [0, 1]
  double min_sigma = 0.005;      ///< [m]
  double min_sigma_yaw = 0.002;  ///< [rad]
  /// Fraction of the odometry noise that is left after calibration.
  double corrected_fraction = 1.0 / 3.0;

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("min_inliers", min_inliers, Range{0.0, 1.0},
             "matches with a smaller inlier fraction are left out");
    ar.field("min_sigma", min_sigma, Range{1e-6, 1.0},
             "standard deviation of any matched position, for surfaces are thick [m]");
    ar.field("min_sigma_yaw", min_sigma_yaw, Range{1e-6, 1.0}, "the same for the heading [rad]");
    ar.field("corrected_fraction", corrected_fraction, Range{0.001, 1.0},
             "fraction of `odometry_distance_noise` that is left after calibration");
  }
};

/// Scans whose beams are measured one after the other. A scan is matched with a predicted velocity;
/// the next odometry pose corrects it.
struct DeskewOptions {
  double max_gap = 1.0;         ///< [s]
  double max_error = 0.002;     ///< [m], [rad]
  double information = 1100.0;  ///< [1/m^2], [1/rad^2]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("max_gap", max_gap, Range{0.0, 100.0},
             "a motion over a longer time does not determine the velocity [s]");
    ar.field(
        "max_error", max_error, Range{0.0, 1.0},
        "a larger error of the prediction over the sweep has the scan matched again [m], [rad]");
    ar.field("information", information, Range{1e-3, 1e9},
             "of the pose that the corrected velocity predicts, about 3 cm and 0.03 rad [1/m^2], "
             "[1/rad^2]");
  }
};

/// The reference of a `scan_matcher` other than point_to_line: the keyframes about the robot.
struct MatcherReferenceOptions {
  double reach = 8.0;               ///< [m]
  int max_keyframes = 40;           ///< of those, the nearest so many
  double max_distance = 2.0;        ///< [m]
  double max_correction = 2.0;      ///< [m]
  double max_correction_yaw = 1.0;  ///< [rad]
  double resolution = 0.05;         ///< [m]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("reach", reach, Range{0.5, 1000.0}, "keyframes within this of the robot are used [m]");
    ar.field("max_keyframes", max_keyframes, Range{1, 10000}, "of those, the nearest so many");
    ar.field("max_distance", max_distance, Range{0.1, 1000.0},
             "the reference is rebuilt when the robot is farther from its center [m]");
    ar.field("max_correction", max_correction, Range{0.01, 100.0},
             "largest correction of a prediction [m]");
    ar.field("max_correction_yaw", max_correction_yaw, Range{0.01, 3.2},
             "the same for the heading [rad]");
    ar.field("resolution", resolution, Range{0.005, 1.0}, "of grids that a matcher makes [m]");
  }
};

/// The search for one scan in the whole map by branch and bound (W. Hess et al., ICRA 2016).
struct RelocalizationOptions {
  double resolution = 0.1;    ///< [m]
  int levels = 8;             ///< levels of the pyramid
  int max_points = 150;       ///< points of a scan that are used
  double min_response = 0.4;  ///< fraction of the points that must hit surfaces

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("resolution", resolution, Range{0.01, 1.0}, "side of the finest cell [m]");
    ar.field("levels", levels, Range{1, 14}, "levels of the pyramid");
    ar.field("max_points", max_points, Range{10, 100000}, "points of a scan that are used");
    ar.field("min_response", min_response, Range{0.01, 1.0},
             "fraction of the points that must hit surfaces");
  }
};

/// `mode: localization`: where the map explains too little of a scan, recent scans are matched
/// instead; where that lasts, the robot is searched for in the whole map and a second pose
/// hypothesis is tracked alongside the first one, as rooms look alike and paths through them do
/// less.
struct LocalizationOptions {
  double min_inliers = 0.75;    ///< in [0, 1]
  double min_fit = 0.75;        ///< in [0, 1]
  int poor_scans = 5;           ///< successive poor scans that start a search in the whole map
  double good_inliers = 0.9;    ///< in [0, 1]
  double min_response = 0.55;   ///< fraction of the points that must hit surfaces in that search
  double lead = 0.15;           ///< in [0, 1]
  double trial_distance = 2.0;  ///< [m]
  int trial_scans = 10;         ///< scans over which it must
  int scans_to_lead = 4;        ///< after so many scans without that lead it is dropped
  double same_place = 0.5;      ///< [m]
  double same_heading = 0.3;    ///< [rad]
  double prior_information = 400.0;  ///< [1/m^2], [1/rad^2]
  int witnesses = 20;                ///< nearest keyframes that show what is free about a pose
  double witness_reach = 6.0;        ///< [m]
  double min_overlap = 0.3;          ///< in [0, 1]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field(
        "min_inliers", min_inliers, Range{0.0, 1.0},
        "a smaller fraction on the map has recent scans asked, and a larger one on them believed");
    ar.field("min_fit", min_fit, Range{0.0, 1.0},
             "scans of which a smaller fraction fits the map are poor");
    ar.field("poor_scans", poor_scans, Range{1, 10000},
             "successive poor scans that start a search in the whole map");
    ar.field("good_inliers", good_inliers, Range{0.0, 1.0},
             "a larger inlier fraction is taken as it is, without looking at free space");
    ar.field("min_response", min_response, Range{0.01, 1.0},
             "fraction of the points that must hit surfaces in that search");
    ar.field("lead", lead, Range{0.0, 1.0},
             "fraction by which the second hypothesis must fit better");
    ar.field("trial_distance", trial_distance, Range{0.0, 1000.0},
             "distance over which it must; rotation alone does not distinguish rooms [m]");
    ar.field("trial_scans", trial_scans, Range{1, 10000}, "scans over which it must");
    ar.field("scans_to_lead", scans_to_lead, Range{1, 10000},
             "after so many scans without that lead it is dropped");
    ar.field("same_place", same_place, Range{0.0, 100.0},
             "a hypothesis that is nearer is no other one [m]");
    ar.field("same_heading", same_heading, Range{0.0, 3.2}, "and whose heading differs less [rad]");
    ar.field("prior_information", prior_information, Range{1e-3, 1e9},
             "of its motion between two scans, about 5 cm and 0.05 rad [1/m^2], [1/rad^2]");
    ar.field("witnesses", witnesses, Range{1, 10000},
             "nearest keyframes that show what is free about a pose");
    ar.field("witness_reach", witness_reach, Range{0.1, 1000.0},
             "keyframes within this of a pose do [m]");
    ar.field("min_overlap", min_overlap, Range{0.0, 1.0},
             "fraction of a scan in what they saw below which they do not count");
  }
};

/// Tracking of the pose, scan by scan, and localization in a known map.
/// No experiment is on record for single values: docs/benchmarks.md holds what `./trident bench
/// slam` measures with these defaults on public logs.
struct FrontEndOptions {
  /// How far odometry is trusted between two scans.
  OdometryNoiseOptions odometry_noise;
  TrackingOptions tracking;               ///< when a match with the local map is accepted
  TrackingSearchOptions tracking_search;  ///< correlative search about the predicted pose
  CalibrationOptions calibration;         ///< learning of the odometry errors
  DeskewOptions deskewing;                ///< scans whose beams are measured one after the other
  /// For matchers other than point_to_line.
  MatcherReferenceOptions matcher_reference;
  RelocalizationOptions relocalization;  ///< search for a scan in the whole map
  LocalizationOptions localization;      ///< detection of a kidnapped robot in `mode: localization`

  /// Names each group.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("odometry_noise", odometry_noise,
             "how far odometry is trusted between two scans (standard deviations)");
    ar.field("tracking", tracking, "when a match with the local map is accepted");
    ar.field("tracking_search", tracking_search, "correlative search about the predicted pose");
    ar.field("calibration", calibration, "learning of the odometry errors");
    ar.field("deskewing", deskewing, "scans whose beams are measured one after the other");
    ar.field("matcher_reference", matcher_reference,
             "reference scans of the matchers other than point_to_line");
    ar.field("relocalization", relocalization, "search for a scan in the whole map");
    ar.field("localization", localization,
             "detection of a kidnapped robot in `mode: localization`");
  }
};

}  // namespace trident::slam
