// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "graph_slam/keyframe_graph.h"
#include "graph_slam/loop_closer.h"
#include "graph_slam/scan_archive.h"
#include "graph_slam/scan_check.h"
#include "graph_slam/scan_tracker.h"
#include "trident_slam/graph_slam_options.h"
#include "trident_slam/slam_2d.h"

namespace trident {

/// State and steps of GraphSlam2d.
class GraphMapper {
 public:
  explicit GraphMapper(const GraphSlamOptions& options);

  ScanPose2d add_scan(const LaserScan& scan, const SE2& T_odom_base);
  void finish();
  std::vector<StampedPose2d> trajectory() const;
  const KeyframeGraph& graph() const { return graph_; }

 private:
  /// Motion by odometry since the last scan, and what is wrong with it.
  struct Motion {
    SE2 T_last_base;
    double doubt = 0.0;  ///< [m]
    std::string problem;
  };

  Motion motion_since_last_scan(const SE2& T_odom_base);
  Eigen::Vector3d twist_of(const LaserScan& scan, const SE2& T_last_base) const;
  bool is_keyframe_due() const;
  void add_keyframe(const std::shared_ptr<const PointScan>& scan, const MatchResult& match);
  void link_to_reused_surfaces(int keyframe, const PointScan& scan);
  void hide_what_drifted();
  void close_loops(int stretch);
  bool accept_loops(const std::vector<GraphEdge>& loops);
  void rebuild_surfaces();
  void match_all_scans_once_more();

  GraphSlamOptions options_;
  ScanCheck check_;
  ScanTracker tracker_;
  KeyframeGraph graph_;
  ScanArchive archive_;
  LoopCloser closer_;
  std::optional<SE2> T_odom_last_;
  std::int64_t last_stamp_ns_ = 0;
  double travelled_ = 0.0;
  std::vector<SE2> final_poses_;                  ///< of the archived scans, after finish()
  std::vector<std::pair<int, int>> reuse_links_;  ///< of the newest stretch: (older, newer)
};

}  // namespace trident
