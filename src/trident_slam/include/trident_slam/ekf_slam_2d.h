// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_slam/ekf_slam.h"
#include "trident_slam/slam_2d.h"

namespace trident::slam {

/// What counts as a post (pillar, trunk, table leg): a narrow object in front of what is around it.
struct PostParams {
  double max_diameter = 0.6;  ///< [m]
  double clearance = 0.3;     ///< [m] that the beams at both sides go farther
  int min_beams = 2;          ///< that end on it
  double max_range = 10.0;    ///< [m]
  double range_sigma = 0.02;  ///< [m] of one beam

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& archive) {
    archive.field("max_diameter", max_diameter, Range::positive(), "[m]");
    archive.field("clearance", clearance, Range::positive(),
                  "that the beams at both sides go farther [m]");
    archive.field("min_beams", min_beams, Range::at_least(1), "that end on it");
    archive.field("max_range", max_range, Range::positive(), "[m]");
    archive.field("range_sigma", range_sigma, Range::positive(), "of one beam [m]");
  }
};

/// Parameters of ekf_slam_2d.
struct EkfSlam2dParams {
  double resolution = 0.05;               ///< of the map [m]
  double odometry_distance_sigma = 0.05;  ///< of the distance travelled, as a share of it
  double odometry_slip_sigma = 0.02;      ///< across, as a share of the distance travelled
  double odometry_turn_sigma = 0.05;      ///< of the angle turned, as a share of it
  double odometry_drift_sigma = 0.02;     ///< [rad/m] of yaw over the distance travelled
  PostParams posts;                       ///< what in a scan is a landmark
  EkfSlamParams filter;                   ///< with the defaults below

  /// Posts stand closer than trees, and a laser sees them all around.
  EkfSlam2dParams() {
    filter.new_distance = 0.6;
    filter.view_range = 8.0;
    filter.view_half_angle = 3.14;
  }

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& archive) {
    archive.field("resolution", resolution, Range{0.005, 1.0}, "of the map [m]");
    archive.field("odometry_distance_sigma", odometry_distance_sigma, Range::non_negative(),
                  "of the distance travelled, as a share of it");
    archive.field("odometry_slip_sigma", odometry_slip_sigma, Range::non_negative(),
                  "across, as a share of the distance travelled");
    archive.field("odometry_turn_sigma", odometry_turn_sigma, Range::non_negative(),
                  "of the angle turned, as a share of it");
    archive.field("odometry_drift_sigma", odometry_drift_sigma, Range::non_negative(),
                  "of yaw over the distance travelled [rad/m]");
    archive.field("posts", posts);
    archive.field("filter", filter);
  }
};

/// EkfSlam over the posts (pillars, trunks) that planar scans show, with odometry between them.
/// Where nothing stands free it is odometry alone. A filter looks at each scan once: final poses
/// are those given when the scans came.
class EkfSlam2d : public Slam2d {
 public:
  /// Throws Error for parameters out of range.
  explicit EkfSlam2d(const EkfSlam2dParams& params = {});
  ~EkfSlam2d() override;

  ScanPose2d add_scan(const LaserScan& scan, const SE2& T_odom_base) override;
  std::vector<StampedPose2d> trajectory() const override;
  /// All scans at their poses.
  OccupancyGrid map() const override;
  /// See EkfSlam::landmarks().
  std::vector<EkfSlam::Landmark> landmarks() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trident::slam
