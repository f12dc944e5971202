// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "graph_slam/backend/pose_graph_backend.h"
#include "graph_slam/local/local_mapper.h"
#include "graph_slam/local/scan_archive.h"
#include "graph_slam/local/scan_deskewer.h"
#include "graph_slam/session/map_editor.h"
#include "graph_slam/session/session.h"
#include "scans/scan_check.h"
#include "trident_slam/graph_slam_options.h"
#include "trident_slam/slam_2d.h"

namespace trident::slam {

/// Holds the map of GraphSlam2d, a graph and an archive of scans, and passes each scan through the
/// front end (LocalMapper) and the back end (PoseGraphBackend).
class GraphMapper {
 public:
  GraphMapper(const GraphSlamOptions& options, const PoseGraphSolverMaker& solver);

  /// See Slam2d.
  ScanPose2d add_scan(const LaserScan& scan, const SE2& T_odom_base);
  /// Ends all searches, aligns all keyframes and matches all archived scans with the final map.
  void finish();
  /// The poses of all archived scans, in the order in which they came.
  std::vector<StampedPose2d> trajectory() const;
  /// The graph of the keyframes.
  const KeyframeGraph& graph() const { return graph_; }
  /// What the keyframes' poses come from: after finish() all pairs of scans, before it the graph's.
  const std::vector<GraphEdge>& measured_edges() const {
    return final_poses_.empty() ? graph_.edges() : final_edges_;
  }
  /// The scan of each keyframe, as `trajectory` counts them.
  std::vector<std::size_t> scans_of_keyframes() const;

  /// A copy of all that a session file holds.
  Session session() const { return {graph_, archive_, tracker().T_map_base(), local_.travelled()}; }
  /// Continues with a session, at `T_map_base` or where it ended.
  void set_session(Session session, const std::optional<SE2>& T_map_base);
  /// Adds a session whose origin is at `T_map_session`. Returns how many loops connect both maps.
  /// Throws Error for a damaged session, and then nothing has changed.
  int append(BinaryReader* reader, const SE2& T_map_session);

  void set_mode(SlamMode mode);
  /// Paused, scans are placed in the map but do not become part of it.
  void set_paused(bool is_paused) { is_paused_ = is_paused; }
  bool is_paused() const { return is_paused_; }
  /// Puts the robot at a pose.
  void set_pose(const SE2& T_map_base);
  /// Searches for a scan in the whole map and puts the robot there if at least `min_inliers` of its
  /// points fit. Returns the pose, or nothing.
  std::optional<SE2> relocalize(const LaserScan& scan, double min_inliers);

  /// See MapEditor.
  bool close_loop(int older, int newer, const SE2& T_older_newer);
  /// See MapEditor.
  std::vector<int> move_keyframes(const std::map<int, SE2>& T_map_base);

  /// The front end.
  LocalMapper& local() { return local_; }
  /// The back end.
  PoseGraphBackend& backend() { return backend_; }

 private:
  const ScanTracker& tracker() const { return local_.tracker(); }
  MapEditor editor() { return {options_.back_end, &graph_, &backend_}; }
  Eigen::Vector3d match_and_map(const LaserScan& scan, LocalMapper::Motion* motion,
                                ScanPose2d* result);
  void finish_pending_scan(std::int64_t next_stamp_ns, const LocalMapper::Motion& motion);
  void archive(const LaserScan& scan, const Eigen::Vector3d& twist, bool is_used);
  void place_relative_to_keyframe(ScanArchive::Entry* entry) const;
  bool is_map_fixed() const { return options_.mode == SlamMode::kLocalization || is_paused_; }
  bool is_keyframe_due() const;

  GraphSlamOptions options_;
  KeyframeGraph graph_;
  ScanArchive archive_;
  ScanCheck check_;
  ScanDeskewer deskewer_;
  LocalMapper local_;
  PoseGraphBackend backend_;
  std::optional<PendingScan> pending_;
  bool is_paused_ = false;
  std::vector<SE2> final_poses_;        ///< of the archived scans, after finish()
  std::vector<GraphEdge> final_edges_;  ///< that finish() aligned the keyframes by
};

}  // namespace trident::slam
