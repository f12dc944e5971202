// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/yaml_config.h"

namespace trident::slam {

/// Edges of the pose graph that tracking adds: to the previous keyframe, and to an older submap
/// whose surfaces a scan was matched with.
struct KeyframeEdgeOptions {
  double sigma = 0.01;             ///< [m]
  double sigma_yaw = 0.005;        ///< [rad]
  double gap_variance = 1.0;       ///< [m^2]
  double gap_variance_yaw = 0.1;   ///< [rad^2]
  double revisit_fraction = 0.25;  ///< in [0, 1]
  /// Preceding submaps that count as the current surroundings, not as a revisited place.
  int own_submaps = 1;
  double revisit_sigma = 0.03;      ///< [m]
  double revisit_sigma_yaw = 0.01;  ///< [rad]
  int deactivation_period = 5;  ///< keyframes after which drifted submaps are searched for again

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("sigma", sigma, Range{1e-6, 10.0},
             "standard deviation that is added to that of a match [m]");
    ar.field("sigma_yaw", sigma_yaw, Range{1e-6, 3.2}, "the same for the heading [rad]");
    ar.field("gap_variance", gap_variance, Range{0.0, 10000.0},
             "variance that is added after the pose was set by hand [m^2]");
    ar.field("gap_variance_yaw", gap_variance_yaw, Range{0.0, 10.0},
             "the same for the heading [rad^2]");
    ar.field("revisit_fraction", revisit_fraction, Range{0.0, 1.0},
             "fraction of the points on an older submap from which on an edge leads to it");
    ar.field("own_submaps", own_submaps, Range{0, 1000},
             "preceding submaps that are the current surroundings, not a revisited place");
    ar.field("revisit_sigma", revisit_sigma, Range{1e-6, 10.0},
             "standard deviation of such an edge [m]");
    ar.field("revisit_sigma_yaw", revisit_sigma_yaw, Range{1e-6, 3.2},
             "the same for the heading [rad]");
    ar.field("deactivation_period", deactivation_period, Range{1, 1000},
             "keyframes after which drifted submaps are searched for again");
  }
};

/// Candidates for loops, and the window that branch and bound searches (W. Hess et al., ICRA 2016).
/// The window grows with the path length through the graph, as drift does.
struct LoopSearchOptions {
  int max_candidates = 4;               ///< places that are compared with each submap
  double place_reach = 8.0;             ///< [m]
  double min_path_fraction = 0.4;       ///< in [0, 1]
  double window = 0.5;                  ///< [m]
  double window_per_meter = 0.03;       ///< [m/m]
  double window_yaw = 0.1;              ///< [rad]
  double window_yaw_per_meter = 0.004;  ///< [rad/m]
  double max_window_yaw = 1.0;          ///< [rad]
  double resolution = 0.1;              ///< [m]
  int levels = 7;                       ///< levels of the pyramid
  int max_points = 300;                 ///< points of the submap that are used
  double min_response = 0.35;           ///< in [0, 1]
  double surfel_cell = 0.1;             ///< [m]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("max_candidates", max_candidates, Range{1, 1000},
             "places that are compared with each submap");
    ar.field("place_reach", place_reach, Range{0.0, 1000.0},
             "distance over which two places share surroundings [m]");
    ar.field("min_path_fraction", min_path_fraction, Range{0.0, 1.0},
             "fraction of `reuse_distance` from which on a place is a candidate");
    ar.field("window", window, Range{0.0, 100.0}, "half side of the window at no path length [m]");
    ar.field("window_per_metre", window_per_meter, Range{0.0, 10.0},
             "growth of it by path length [m/m]");
    ar.field("window_yaw", window_yaw, Range{0.0, 3.2},
             "half range of the heading at no path length [rad]");
    ar.field("window_yaw_per_metre", window_yaw_per_meter, Range{0.0, 10.0},
             "growth of it by path length [rad/m]");
    ar.field("max_window_yaw", max_window_yaw, Range{0.0, 3.2},
             "largest half range of the heading [rad]");
    ar.field("resolution", resolution, Range{0.01, 1.0}, "side of the finest cell [m]");
    ar.field("levels", levels, Range{1, 12}, "levels of the pyramid");
    ar.field("max_points", max_points, Range{10, 100000}, "points of the submap that are used");
    ar.field("min_response", min_response, Range{0.0, 1.0},
             "fraction of the points that must hit surfaces");
    ar.field("surfel_cell", surfel_cell, Range{0.01, 1.0},
             "side of a cell of the surfaces for the refinement [m]");
  }
};

/// Which loop candidates are accepted: those that fit what both places saw and that are pairwise
/// consistent with others (J. Mangelson et al., "Pairwise consistent measurement set maximization
/// for robust multi-robot map merging", ICRA 2018).
struct LoopVerificationOptions {
  double min_overlap = 0.35;           ///< in [0, 1]
  double search_gain = 0.05;           ///< in [0, 1]
  double min_residual = 0.5;           ///< [m]
  double max_path = 80.0;              ///< [m]
  double max_error = 0.2;              ///< [m]
  double error_per_meter = 0.01;       ///< [m/m]
  double max_error_yaw = 0.03;         ///< [rad]
  double error_yaw_per_meter = 0.001;  ///< [rad/m]
  int min_group = 2;                   ///< candidates that must be consistent with each other
  double long_path = 150.0;            ///< [m]
  int min_group_long = 3;              ///< as min_group, beyond long_path
  double information = 1e3;            ///< [1/m^2]
  double information_yaw = 1e4;        ///< [1/rad^2]
  double max_residual = 0.3;           ///< [m]
  double max_residual_yaw = 0.1;       ///< [rad]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("min_overlap", min_overlap, Range{0.0, 1.0},
             "fraction of the points that both places must have seen");
    ar.field("search_gain", search_gain, Range{0.0, 1.0},
             "agreement by which a pose from the search must exceed that of the pose at hand");
    ar.field("min_residual", min_residual, Range{0.0, 100.0},
             "within `reuse_distance`, a loop that moves the submap less is left to tracking [m]");
    ar.field("max_path", max_path, Range{0.0, 10000.0},
             "two candidates are compared over a path of at most this length [m]");
    ar.field("max_error", max_error, Range{0.0, 100.0},
             "by which two consistent candidates differ at most, at no path length [m]");
    ar.field("error_per_metre", error_per_meter, Range{0.0, 1.0},
             "growth of it by path length [m/m]");
    ar.field("max_error_yaw", max_error_yaw, Range{0.0, 3.2}, "the same for the heading [rad]");
    ar.field("error_yaw_per_metre", error_yaw_per_meter, Range{0.0, 1.0},
             "growth of it by path length [rad/m]");
    ar.field("min_group", min_group, Range{1, 100},
             "candidates that must be consistent with each other");
    ar.field("long_path", long_path, Range{0.0, 100000.0},
             "beyond this path length more places look alike [m] ...");
    ar.field("min_group_long", min_group_long, Range{1, 100},
             "... and so many candidates must be consistent");
    ar.field("information", information, Range{1e-3, 1e9}, "of the edge of a loop [1/m^2]");
    ar.field("information_yaw", information_yaw, Range{1e-3, 1e9},
             "the same for the heading [1/rad^2]");
    ar.field("max_residual", max_residual, Range{0.0, 100.0},
             "a loop that the optimized graph misses by more is rejected [m]");
    ar.field("max_residual_yaw", max_residual_yaw, Range{0.0, 3.2},
             "the same for the heading [rad]");
  }
};

/// What a scan shows to be free or occupied, for the verification of loops and hypotheses and for
/// pruning.
struct FreeSpaceOptions {
  double margin = 0.3;             ///< [m]
  double margin_per_meter = 0.03;  ///< in [0, 1]
  double on_surface = 0.15;        ///< [m]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("margin", margin, Range{0.0, 10.0},
             "points nearer to the scanner than a return by this were seen through [m] ...");
    ar.field("margin_per_metre", margin_per_meter, Range{0.0, 1.0},
             "... plus this fraction of the range");
    ar.field("on_surface", on_surface, Range{0.0, 10.0},
             "points nearer to a surface are on it [m]");
  }
};

/// The optimization of the pose graph. Cauchy's kernel holds for edges to revisited places, which
/// are not verified.
struct GraphOptimizationOptions {
  double kernel = 3.0;      ///< [standard deviations]
  int max_iterations = 20;  ///< Gauss-Newton steps

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("kernel", kernel, Range{0.1, 1000.0}, "width of the kernel [standard deviations]");
    ar.field("max_iterations", max_iterations, Range{1, 10000}, "Gauss-Newton steps");
  }
};

/// The alignment of all keyframes at the end: each scan is matched with those about it, and one
/// system of all pairs is solved.
/// F. Lu and E. Milios, "Globally consistent range scan alignment", Autonomous Robots 4, 1997.
struct AlignmentOptions {
  double reach = 4.0;           ///< [m]
  int partners = 4;             ///< matched with each keyframe, besides its predecessors
  int predecessors = 4;         ///< keyframes before it that a keyframe is always matched with
  double min_inliers = 0.4;     ///< in [0, 1]
  double max_change = 0.5;      ///< [m]
  double max_change_yaw = 0.2;  ///< [rad]
  double surfel_cell = 0.1;     ///< [m]
  int max_points = 360;         ///< points of each scan that are used
  double converged = 1e-3;      ///< [m]
  /// Fraction of a match's information that counts, as errors of neighboring beams are correlated.
  double information_fraction = 0.1;
  double settled = 0.3;  ///< [m]
  int max_passes = 3;    ///< how often at most

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("reach", reach, Range{0.1, 1000.0},
             "keyframes at most this far apart see the same surfaces [m]");
    ar.field("partners", partners, Range{0, 1000},
             "matched with each keyframe, besides its predecessors");
    ar.field("predecessors", predecessors, Range{1, 1000},
             "keyframes before it that a keyframe is always matched with");
    ar.field("min_inliers", min_inliers, Range{0.0, 1.0},
             "pairs with a smaller inlier fraction are left out");
    ar.field("max_change", max_change, Range{0.0, 100.0},
             "matches that move a keyframe farther are left out [m]");
    ar.field("max_change_yaw", max_change_yaw, Range{0.0, 3.2}, "the same for the heading [rad]");
    ar.field("surfel_cell", surfel_cell, Range{0.01, 1.0},
             "side of a cell of a scan's surfaces [m]");
    ar.field("max_points", max_points, Range{10, 100000}, "points of each scan that are used");
    ar.field("converged", converged, Range{1e-9, 1.0},
             "a smaller step ends a match; the mean of many is better than that [m]");
    ar.field("information_fraction", information_fraction, Range{1e-6, 1.0},
             "fraction of a match's information that counts, for errors of neighboring beams are "
             "correlated");
    ar.field("settled", settled, Range{0.0, 100.0},
             "pairs are matched again if a keyframe has moved farther [m]");
    ar.field("max_passes", max_passes, Range{1, 100}, "how often at most");
  }
};

/// The match of every archived scan with the final map (`keep_scans`).
struct FinalMatchOptions {
  int max_points = 120;      ///< of a larger scan that are used
  int min_points = 200;      ///< up to so many points of a scan all are used, against noise
  int search_rings = 2;      ///< cells about a point in which its surface is searched for
  double converged = 1e-3;   ///< [m]
  double sigma = 0.01;       ///< [m]
  double sigma_yaw = 0.005;  ///< [rad]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("max_points", max_points, Range{10, 100000}, "points of each scan that are used ...");
    ar.field("min_points", min_points, Range{0, 100000},
             "... unless it has no more than so many: then all count against noise");
    ar.field("search_rings", search_rings, Range{1, 10},
             "cells about a point in which its surface is searched for");
    ar.field("converged", converged, Range{1e-9, 1.0}, "a smaller step ends a match [m]");
    ar.field("sigma", sigma, Range{1e-6, 10.0},
             "standard deviation of a scan's position relative to its keyframe [m]");
    ar.field("sigma_yaw", sigma_yaw, Range{1e-6, 3.2}, "the same for the heading [rad]");
  }
};

/// `mode: lifelong` beyond the scores of slam_toolbox (`lifelong_*`).
struct PruningOptions {
  double min_path = 20.0;  ///< [m]
  double min_seen = 0.9;   ///< in [0, 1]
  /// Removed or thinned scans after which graph and surfaces are rebuilt.
  int batch = 20;

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("min_path", min_path, Range{0.0, 10000.0},
             "scans on a shorter path to the newest one are its own surroundings [m]");
    ar.field("min_seen", min_seen, Range{0.0, 1.0},
             "fraction of a scan's points that newer scans must have seen before it is removed");
    ar.field("batch", batch, Range{1, 10000},
             "scans that were removed or thinned after which graph and surfaces are rebuilt");
  }
};

/// Maps that a user corrects by hand, and maps that are joined.
struct MapEditOptions {
  double reach = 3.0;                   ///< [m]
  double path_length = 20.0;            ///< [m]
  double min_inliers = 0.4;             ///< in [0, 1]
  double join_information = 1.0;        ///< [1/m^2]
  double join_information_yaw = 100.0;  ///< [1/rad^2]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("reach", reach, Range{0.1, 1000.0},
             "submaps within this of where a keyframe was moved are compared with it [m]");
    ar.field("path_length", path_length, Range{0.0, 10000.0},
             "that a position set by hand is as uncertain as, see `loop_search` [m]");
    ar.field("min_inliers", min_inliers, Range{0.0, 1.0},
             "of the scans of a loop that a user closed");
    ar.field("join_information", join_information, Range{1e-9, 1e9},
             "of the edge between two joined maps [1/m^2]");
    ar.field("join_information_yaw", join_information_yaw, Range{1e-9, 1e9},
             "the same for the heading [1/rad^2]");
  }
};

/// The pose graph: its edges, loops, optimization, pruning and editing.
/// No experiment is on record for single values: docs/benchmarks.md holds what `./trident bench
/// slam` measures with these defaults on public logs.
struct BackEndOptions {
  KeyframeEdgeOptions keyframe_edges;  ///< uncertainty of the edges that tracking adds
  LoopSearchOptions loop_search;       ///< candidates for loops and the window of their search
  LoopVerificationOptions loop_verification;  ///< which loops are accepted
  FreeSpaceOptions free_space;                ///< what a scan shows to be free
  GraphOptimizationOptions optimization;      ///< optimization of the pose graph
  AlignmentOptions alignment;     ///< all pairs of scans that see the same surfaces, at the end
  FinalMatchOptions final_match;  ///< match of every archived scan with the final map
  PruningOptions pruning;         ///< lifelong mode beyond slam_toolbox' scores
  MapEditOptions editing;         ///< corrections by hand and joined maps

  /// Names each group.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("keyframe_edges", keyframe_edges, "uncertainty of the edges that tracking adds");
    ar.field("loop_search", loop_search, "candidates for loops and the window of their search");
    ar.field("loop_verification", loop_verification, "which loops are accepted");
    ar.field("free_space", free_space, "what a scan shows to be free");
    ar.field("optimization", optimization, "optimization of the pose graph");
    ar.field("alignment", alignment, "all pairs of scans that see the same surfaces, at the end");
    ar.field("final_match", final_match, "match of every archived scan with the final map");
    ar.field("pruning", pruning, "lifelong mode beyond slam_toolbox' scores");
    ar.field("editing", editing, "corrections by hand and joined maps");
  }
};

}  // namespace trident::slam
