// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "calibrated_odometry.h"
#include "graph_slam/loop/kidnap_detector.h"
#include "motion/motion_filter.h"
#include "motion/motion_source.h"
#include "pose_uncertainty.h"
#include "recent_scans.h"
#include "scan_tracker.h"
#include "submap_matcher.h"
#include "trident_slam/graph_slam_options.h"
#include "trident_slam/slam_2d.h"

namespace trident::slam {

/// The front end: predicts the motion between two scans and matches each scan with the surfaces of
/// the active submaps; in localization mode it also detects a kidnapped robot. It does not change
/// the graph, which must outlive it. Calls for each scan, in this order: `predict`; `match` for a
/// usable scan, else `coast`; `finish_motion`.
class LocalMapper {
 public:
  using Motion = OdometryMotion::Step;

  LocalMapper(const GraphSlamOptions& options, const KeyframeGraph* graph);
  LocalMapper(const LocalMapper&) = delete;
  LocalMapper& operator=(const LocalMapper&) = delete;

  /// The motion since the last scan: by calibrated odometry, or as the scans let expect it.
  Motion predict(std::int64_t stamp_ns, const SE2& T_odom_base);
  /// Finds the scan's pose in the map. Where scans replace odometry, `motion` becomes theirs.
  MatchResult match(const std::shared_ptr<const PointScan>& points, const SE2& T_base_laser,
                    Motion* motion);
  /// Moves by the prediction alone.
  void coast(const Motion& motion);
  /// Matches a scan again, about `prior`.
  MatchResult match_again(const PointScan& points, const PosePrior& prior);
  /// Ends the step of a scan; `is_shown` false: the scan showed nothing of the motion. Returns a
  /// notice about odometry for the user, seldom any.
  std::string finish_motion(const Motion& motion, bool is_shown);
  /// Fills in the covariance of a pose and what measured the motion up to it.
  void report_uncertainty(const Motion& motion, const MatchResult& match, const PointScan& points,
                          ScanPose2d* result);

  /// True where the robot has moved on from a scan at `T_map_last` by more than the travel minima.
  bool has_moved_from(const SE2& T_map_last) const {
    return keyframe_filter_.is_due(T_map_last.inverse() * tracker_.T_map_base());
  }
  /// Puts the robot at a pose; nothing is known of how it came there.
  void set_pose(const SE2& T_map_base);
  void set_mode(SlamMode mode);
  void set_uses_odometry(bool uses_odometry) { motion_source_.set_uses_odometry(uses_odometry); }
  /// The next pose of odometry is the first one again.
  void forget_odometry() { motion_source_.forget_odometry(); }
  void clear_recent_scans() { recent_scans_.clear(); }

  const ScanTracker& tracker() const { return tracker_; }
  ScanTracker& tracker() { return tracker_; }
  const CalibratedOdometry& calibration() const { return calibration_; }
  /// Path length so far [m].
  double travelled() const { return travelled_; }
  void set_travelled(double travelled) { travelled_ = travelled; }

 private:
  MatchResult localize(const std::shared_ptr<const PointScan>& points, const Motion& motion,
                       const MatchResult& tracked);
  void fall_back_to_recent_scans(const std::shared_ptr<const PointScan>& points,
                                 MatchResult* match);

  GraphSlamOptions options_;
  const KeyframeGraph* graph_;
  MotionFilter keyframe_filter_;
  MotionSource motion_source_;
  PoseUncertainty uncertainty_;
  CalibratedOdometry calibration_;
  ScanTracker tracker_;
  std::optional<SubmapMatcher> submap_matcher_;  ///< of `scan_matcher`, if not the default one
  RecentScans recent_scans_;
  KidnapDetector kidnap_detector_;
  double travelled_ = 0.0;
};

}  // namespace trident::slam
