// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "matchers/line_match.h"
#include "motion/odometry_motion.h"
#include "trident_base/laser_scan.h"
#include "trident_slam/graph_slam_options.h"

namespace trident::slam {

/// The newest scan if its beams were measured one after the other. It becomes part of the map when
/// the next scan's odometry shows how the base moved meanwhile.
struct PendingScan {
  LaserScan scan;
  Eigen::Vector3d twist;     ///< as predicted: (x, y [m/s], yaw [rad/s]) in the base frame
  MatchResult match;         ///< of the points by that twist
  bool is_archived = false;  ///< the last entry of the archive is this scan
};

/// Converts scans to points where each beam is taken from where the base was when it was measured.
class ScanDeskewer {
 public:
  explicit ScanDeskewer(const GraphSlamOptions& options);

  /// The velocity during a scan, if the base moves on as it did since the last one; zero without
  /// `deskew`. `T_last_base`: motion since the last scan.
  Eigen::Vector3d predict_twist(const LaserScan& scan, const SE2& T_last_base) const;
  /// The velocity during a pending scan by the motion up to the next scan at `next_stamp_ns`; the
  /// predicted one where that motion is unknown or took too long.
  Eigen::Vector3d correct_twist(const PendingScan& pending, std::int64_t next_stamp_ns,
                                const OdometryMotion::Step& motion) const;
  /// The returns within the used ranges, in the base frame at the scan's stamp.
  PointScan points(const LaserScan& scan, const Eigen::Vector3d& twist) const;
  /// True where a corrected twist displaces the beams so far that the scan is to be matched again.
  bool is_match_outdated(const PendingScan& pending, const Eigen::Vector3d& twist) const;
  /// The pose of the base by a corrected twist: in the middle of the sweep the predicted and the
  /// corrected motion put it at the same place. `T_map_base`: the pose by the predicted twist.
  PosePrior corrected_prior(const PendingScan& pending, const Eigen::Vector3d& twist,
                            const SE2& T_map_base) const;

  /// The scan at `stamp_ns` is the last one from now on.
  void set_last_stamp(std::int64_t stamp_ns) { last_stamp_ns_ = stamp_ns; }
  std::int64_t last_stamp() const { return last_stamp_ns_; }
  bool is_enabled() const { return is_enabled_; }

 private:
  bool is_enabled_;
  DeskewOptions options_;
  PointScanOptions ranges_;
  std::int64_t last_stamp_ns_ = 0;
};

}  // namespace trident::slam
