// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "graph_slam/backend/keyframe_graph.h"
#include "grids/surfel_map.h"
#include "trident_slam/graph_slam_front_end.h"
#include "trident_slam/scan_matcher.h"

namespace trident::slam {

/// Any ScanMatcher as the graph's front end: its reference is made of the keyframes about the
/// robot, and rebuilt when the robot has left their middle or the graph has moved them.
class SubmapMatcher {
 public:
  /// Throws Error with the legal names for an unknown one.
  SubmapMatcher(const std::string& name, const MatcherReferenceOptions& options);

  /// Keyframes of owners that `surfaces` hides are left out.
  MatchResult match(const KeyframeGraph& graph, const SurfelMap& surfaces, const PointScan& scan,
                    const SE2& guess, const PosePrior& prior);

 private:
  struct Used {
    int keyframe = 0;
    SE2 T_map_base;
  };

  bool is_outdated(const KeyframeGraph& graph, const SurfelMap& surfaces,
                   const Eigen::Vector2d& p_map) const;
  void rebuild(const KeyframeGraph& graph, const SurfelMap& surfaces, const Eigen::Vector2d& p_map);
  void use(const KeyframeGraph& graph, int keyframe);

  MatcherReferenceOptions options_;
  std::unique_ptr<ScanMatcher> matcher_;
  std::vector<Used> used_;
  int known_ = 0;  ///< keyframes that the graph had
  Eigen::Vector2d center_ = Eigen::Vector2d::Zero();
};

}  // namespace trident::slam
