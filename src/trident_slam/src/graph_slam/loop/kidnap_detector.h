// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "graph_slam/backend/keyframe_graph.h"
#include "matchers/line_match.h"
#include "trident_slam/graph_slam_back_end.h"
#include "trident_slam/graph_slam_front_end.h"

namespace trident::slam {

/// Notices that a robot in a known map is not where it is believed to be, and finds it. A scan
/// contradicts a pose by points where keyframes about it saw free space; points where they saw
/// nothing do not count, as a map need not be complete. A pose elsewhere is tracked alongside the
/// believed one for some distance before it is believed instead: rooms look alike, paths through
/// them less so.
class KidnapDetector {
 public:
  /// `search`: the search in the whole map, with `options.min_response` in place of its own.
  KidnapDetector(const LocalizationOptions& options, const RelocalizationOptions& search,
                 const FreeSpaceOptions& free_space)
      : options_(options), search_(search), free_space_(free_space) {
    search_.min_response = options.min_response;
  }

  /// After each scan. `T_last_base`: motion since the last one; `own`: where it was put. Returns
  /// where the robot is instead, when that is sure.
  std::optional<MatchResult> check(const KeyframeGraph& graph, const SurfelMap& surfels,
                                   const PointScan& scan, const SE2& T_last_base,
                                   const MatchResult& own, const LineMatchOptions& line);
  /// Forgets the second hypothesis and the poor scans so far.
  void reset() {
    hypothesis_.reset();
    poor_in_a_row_ = 0;
  }

 private:
  /// Another place that the robot may be at.
  struct PoseHypothesis {
    MatchResult match;
    double path_length = 0.0;  ///< since it was found [m]
    double lead = 0.0;         ///< sum of what it fitted better by
    double fit = 0.0;          ///< sum of its own
    int scans = 0;
  };
  void search(const KeyframeGraph& graph, const SurfelMap& surfels, const PointScan& scan,
              const MatchResult& own, double own_fit, const LineMatchOptions& line);
  void follow(const KeyframeGraph& graph, const SurfelMap& surfels, const PointScan& scan,
              const SE2& T_last_base, double own_fit, const LineMatchOptions& line);
  std::optional<MatchResult> end_trial();

  /// The fraction of a scan's points that fits a pose, of those that could.
  double fit(const KeyframeGraph& graph, const SurfelMap& surfels, const PointScan& scan,
             const MatchResult& match) const;

  LocalizationOptions options_;
  RelocalizationOptions search_;
  FreeSpaceOptions free_space_;
  std::optional<PoseHypothesis> hypothesis_;
  int poor_in_a_row_ = 0;
};

}  // namespace trident::slam
