// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "graph_slam/backend/pose_graph_backend.h"
#include "session.h"

namespace trident::slam {

/// Corrections of a map by its user: loops, moved keyframes, joined maps. It works on a graph and
/// its back end that must outlive it.
class MapEditor {
 public:
  MapEditor(const BackEndOptions& options, KeyframeGraph* graph, PoseGraphBackend* backend)
      : options_(options), graph_(graph), backend_(backend) {}

  /// Adds an edge between two keyframes, refined by their scans, and optimizes. False if the scans
  /// do not fit to each other. `tracking`: of a match.
  bool close_loop(int older, int newer, const SE2& T_older_newer,
                  const ScanTrackerOptions& tracking);
  /// Adds an edge from each keyframe to the submap at the pose where the user moved it, and
  /// optimizes. Returns the keyframes whose surroundings do not fit there; the graph is unchanged
  /// if that is all of them.
  std::vector<int> move_keyframes(const std::map<int, SE2>& T_map_base);
  /// Appends the graph of a session whose origin is at `T_map_session`; path lengths of its
  /// keyframes grow by `gap` [m]. Returns its first keyframe. Surfaces and archive are the
  /// caller's.
  int join(const KeyframeGraph& other, const SE2& T_map_session, double gap);

 private:
  std::optional<GraphEdge> make_edge_at_pose(int keyframe, const SE2& T_map_base) const;
  std::vector<int> submaps_near(int own, const Eigen::Vector2d& place) const;
  void pad_last_submap();

  BackEndOptions options_;
  KeyframeGraph* graph_;
  PoseGraphBackend* backend_;
};

}  // namespace trident::slam
