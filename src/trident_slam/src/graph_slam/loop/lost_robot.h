// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "graph_slam/backend/keyframe_graph.h"
#include "matchers/line_match.h"

namespace trident::slam {

/// Notices that a robot in a known map is not where it is believed to be, and finds it. A scan
/// tells against a pose by points where keyframes about it saw free space; points where they saw
/// nothing do not count, as a map need not be complete. A place elsewhere is followed beside the
/// believed one for some way before it is believed instead: rooms look alike, ways through them
/// less so.
class LostRobot {
 public:
  /// After each scan. `T_last_base`: motion since the last one; `own`: where it was put. Returns
  /// where the robot is instead, when that is sure.
  std::optional<MatchResult> check(const KeyframeGraph& graph, const SurfelMap& surfels,
                                   const PointScan& scan, const SE2& T_last_base,
                                   const MatchResult& own, const LineMatchOptions& line);
  void reset() { *this = LostRobot(); }

 private:
  /// Another place that the robot may be at.
  struct Rival {
    MatchResult match;
    double way = 0.0;   ///< since it was found [m]
    double lead = 0.0;  ///< sum of what it fitted better by
    double fit = 0.0;   ///< sum of its own
    int scans = 0;
  };
  void seek(const KeyframeGraph& graph, const SurfelMap& surfels, const PointScan& scan,
            const MatchResult& own, double own_fit, const LineMatchOptions& line);
  void follow(const KeyframeGraph& graph, const SurfelMap& surfels, const PointScan& scan,
              const SE2& T_last_base, double own_fit, const LineMatchOptions& line);

  std::optional<Rival> rival_;
  int poor_in_a_row_ = 0;
};

}  // namespace trident::slam
