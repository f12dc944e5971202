// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "graph_slam/backend/keyframe_graph.h"
#include "graph_slam/backend/stale_scans.h"
#include "graph_slam/local/calibrated_odometry.h"
#include "graph_slam/local/pose_uncertainty.h"
#include "graph_slam/local/recent_scans.h"
#include "graph_slam/local/scan_archive.h"
#include "graph_slam/local/scan_tracker.h"
#include "graph_slam/local/submap_matcher.h"
#include "graph_slam/loop/loop_worker.h"
#include "graph_slam/loop/lost_robot.h"
#include "motion/motion_filter.h"
#include "motion/motion_source.h"
#include "scans/scan_check.h"
#include "trident_slam/graph_slam_options.h"
#include "trident_slam/slam_2d.h"

namespace trident::slam {

/// All that a session file holds. A copy shares the scans of the keyframes with the mapper.
struct MapperState {
  KeyframeGraph graph;
  ScanArchive archive;
  SE2 T_map_base;
  double travelled = 0.0;

  void save(BinaryWriter* writer) const;
  /// Throws Error, and then nothing has changed.
  void load(BinaryReader* reader);
};

/// State and steps of GraphSlam2d, whose header tells what the public ones mean.
class GraphMapper {
 public:
  GraphMapper(const GraphSlamOptions& options, const PoseGraphSolverMaker& solver);

  ScanPose2d add_scan(const LaserScan& scan, const SE2& T_odom_base);
  void finish();
  std::vector<StampedPose2d> trajectory() const;
  const KeyframeGraph& graph() const { return graph_; }
  /// What the keyframes' poses come from: after finish() all pairs of scans, before it the graph's.
  const std::vector<GraphEdge>& measured_edges() const {
    return final_poses_.empty() ? graph_.edges() : final_edges_;
  }
  /// The scan of each keyframe, as `trajectory` counts them.
  std::vector<std::size_t> scans_of_keyframes() const;
  const CalibratedOdometry& calibration() const { return calibration_; }

  MapperState state() const { return {graph_, archive_, tracker_.T_map_base(), travelled_}; }
  void set_state(MapperState state, const std::optional<SE2>& T_map_base);
  void set_mode(SlamMode mode) {
    options_.mode = mode;
    recent_scans_.clear();
  }
  void set_uses_odometry(bool uses_odometry) { motion_source_.set_uses_odometry(uses_odometry); }
  void set_paused(bool is_paused) { is_paused_ = is_paused; }
  bool is_paused() const { return is_paused_; }
  void set_pose(const SE2& T_map_base);
  void clear_localization_buffer() { recent_scans_.clear(); }
  std::optional<SE2> relocalize(const PointScan& scan, double min_inliers);
  PointScan points_of(const LaserScan& scan, const Eigen::Vector3d& twist) const;
  bool close_loop(int older, int newer, const SE2& T_older_newer);
  /// Optimises anew, at once or in the background.
  void realign(Realign realign);
  bool is_busy() const { return worker_.is_busy(); }
  std::vector<int> move_keyframes(const std::map<int, SE2>& T_map_base);
  int append(BinaryReader* reader, const SE2& T_map_session);

 private:
  /// The newest scan if its beams were measured one after the other. It becomes part of the map
  /// when the next one's odometry tells how the base moved meanwhile.
  struct RollingScan {
    LaserScan scan;
    Eigen::Vector3d twist;  ///< that was guessed
    MatchResult match;
    bool is_archived = false;
  };

  Eigen::Vector3d twist_of(const LaserScan& scan, const SE2& T_last_base) const;
  void settle_rolling_scan(std::int64_t next_stamp_ns, const OdometryMotion::Step& motion);
  std::string settle_motion(const OdometryMotion::Step& motion, bool is_shown);
  void tell_uncertainty(const OdometryMotion::Step& motion, const MatchResult& match,
                        const PointScan& points, ScanPose2d* result);
  MatchResult place(const std::shared_ptr<const PointScan>& points,
                    const OdometryMotion::Step& motion, const SE2& T_base_laser);
  void go_on_from_recent_scans(const std::shared_ptr<const PointScan>& points, MatchResult* match);
  bool is_keyframe_due() const;
  void add_keyframe(const std::shared_ptr<const PointScan>& scan, const MatchResult& match);
  void tie_to_previous_keyframe(int keyframe, const MatchResult& match);
  void tie_to_reused_surfaces(int keyframe, const PointScan& scan);
  void hide_what_drifted();
  void forget_replaced_scans();
  void take_out_forgotten_keyframes();
  void close_loops(int stretch);
  void take_from_worker();
  void apply(LoopOutcome outcome);
  void rebuild_surfaces();
  /// After edges of the user's: the loops that are under way know nothing of them.
  void optimize_anew();
  std::optional<GraphEdge> edge_to_what_lies_at(int keyframe, const SE2& T_map_base) const;
  void begin_stretch();
  int close_loops_across(int first_newer);

  GraphSlamOptions options_;
  ScanCheck check_;
  MotionFilter keyframe_filter_;
  MotionSource motion_source_;
  PoseUncertainty uncertainty_;
  CalibratedOdometry calibration_;
  ScanTracker tracker_;
  std::optional<SubmapMatcher> submap_matcher_;  ///< of the parameter, if not the default one
  KeyframeGraph graph_;
  ScanArchive archive_;
  LoopWorker worker_;
  StaleScans stale_scans_;
  RecentScans recent_scans_;
  LostRobot lost_robot_;
  std::optional<RollingScan> rolling_;
  std::int64_t last_stamp_ns_ = 0;
  double travelled_ = 0.0;
  bool is_paused_ = false;
  bool is_chain_broken_ = false;  ///< the next keyframe does not follow from the one before it
  int forgotten_scans_ = 0;       ///< or thinned, since the surfaces were made last
  std::vector<SE2> final_poses_;  ///< of the archived scans, after finish()
  std::vector<GraphEdge> final_edges_;            ///< that finish() aligned the keyframes by
  std::vector<std::pair<int, int>> reuse_links_;  ///< stretches: (older, newer)
};

}  // namespace trident::slam
