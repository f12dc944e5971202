// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_slam/slam_2d.h"
#include "trident_slam/slam_2d_capabilities.h"

namespace trident::slam {

/// Names and meanings are those of hector_mapping; the map grows by itself, so it has no size here.
struct HectorSlamParams {
  double map_resolution = 0.05;             ///< of the finest level [m]
  int map_multi_res_levels = 3;             ///< each twice as coarse as the one before
  double update_factor_free = 0.4;          ///< probability that a cell a beam passed is occupied
  double update_factor_occupied = 0.9;      ///< the same of a cell where one ended
  double map_update_distance_thresh = 0.4;  ///< [m] travelled since the last update of the map
  double map_update_angle_thresh = 0.9;     ///< [rad] turned since
  double laser_min_dist = 0.1;              ///< [m]
  double laser_max_dist = 30.0;             ///< [m]
  bool use_odometry = true;                 ///< as the start of each match; false: the scans alone
  bool map_with_known_poses = false;        ///< odometry is believed, nothing is matched

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& archive) {
    archive.field("map_resolution", map_resolution, Range{0.005, 1.0}, "of the finest level [m]");
    archive.field("map_multi_res_levels", map_multi_res_levels, Range{1, 8},
                  "each twice as coarse as the one before");
    archive.field("update_factor_free", update_factor_free, Range{0.0, 0.5, true, true},
                  "probability that a cell which a beam passed is occupied");
    archive.field("update_factor_occupied", update_factor_occupied, Range{0.5, 1.0, true, true},
                  "probability that a cell in which a beam ended is occupied");
    archive.field("map_update_distance_thresh", map_update_distance_thresh, Range::non_negative(),
                  "travelled since the last update of the map [m]");
    archive.field("map_update_angle_thresh", map_update_angle_thresh, Range::non_negative(),
                  "turned since [rad]");
    archive.field("laser_min_dist", laser_min_dist, Range::non_negative(), "[m]");
    archive.field("laser_max_dist", laser_max_dist, Range::positive(), "[m]");
    archive.field("use_odometry", use_odometry, "as the start of each match");
    archive.field("map_with_known_poses", map_with_known_poses,
                  "odometry is believed, nothing is matched");
  }
};

/// Scan-to-map SLAM: each scan is aligned with the occupancy map so far by Gauss-Newton over its
/// bilinearly interpolated probabilities, from the coarsest level to the finest (Kohlbrecher, von
/// Stryk, Meyer, Klingauf: A flexible and scalable SLAM system with full 3D motion estimation, SSRR
/// 2011). It needs no odometry: without, or where odometry stands
/// while scans move, a match begins where the scan lies relative to those before it, and it never
/// closes a loop: final poses are those given when the scans came.
class HectorSlam2d : public Slam2d, public PoseInitializable, public Slam2dOdometryUse {
 public:
  /// Throws Error for parameters out of range.
  explicit HectorSlam2d(const HectorSlamParams& params = {});
  ~HectorSlam2d() override;

  ScanPose2d add_scan(const LaserScan& scan, const SE2& T_odom_base) override;
  std::vector<StampedPose2d> trajectory() const override;
  OccupancyGrid map() const override;

  void set_uses_odometry(bool uses_odometry) override;
  /// From now on the base is there; the map stays.
  void set_pose(const SE2& T_map_base) override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trident::slam
