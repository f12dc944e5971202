// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "trident_base/laser_scan.h"
#include "trident_base/occupancy_grid.h"
#include "trident_base/se2.h"

namespace trident::slam {

/// Source of the motion between scans: odometry; scans, because odometry does not report motion;
/// scans, because the user wants it.
enum class MotionBy { kOdometry, kScansAsOdometryStands, kScansAsAsked };

/// What one scan led to, at the moment when it was consumed.
struct ScanPose2d {
  SE2 T_map_base;                                            ///< at the scan's stamp
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< of (x [m], y [m], yaw [rad])
  bool is_used = true;  ///< false: the scan had no usable return, the pose is odometry's
  std::string problem;  ///< empty, or one line on what was wrong with the scan
  MotionBy motion_by = MotionBy::kOdometry;  ///< source of the motion since the scan before
  /// By scans alone: they leave a direction open (a corridor), along which the covariance grows.
  bool is_open = false;
};

/// The pose of one scan, in the order in which scans came.
struct StampedPose2d {
  std::int64_t stamp_ns = 0;  ///< that of the scan, as it came
  SE2 T_map_base;             ///< as known when it was asked for
};

/// One algorithm of simultaneous localisation and mapping with a planar laser scanner. No clock, no
/// threads that change results: the same scans give the same poses and the same map to the bit, and
/// the pose returned for scan k depends on scans 0..k alone. Stamps are labels; scans are taken in
/// the order of the calls. One scan with NaN, infinite or zero ranges, another number of beams or
/// a jump of odometry does not harm the map: it is reported in `problem`.
class Slam2d {
 public:
  Slam2d() = default;
  Slam2d(const Slam2d&) = delete;
  Slam2d& operator=(const Slam2d&) = delete;
  virtual ~Slam2d() = default;

  /// `T_odom_base`: odometry at the scan's stamp, in any fixed frame. The first call's pose in the
  /// map is the identity unless the algorithm was given another one (`PoseInitializable`, its
  /// file).
  virtual ScanPose2d add_scan(const LaserScan& scan, const SE2& T_odom_base) = 0;

  /// Ends the log: pending loop closures and a last optimisation. May be called again.
  virtual void finish() {}

  /// Every scan of `add_scan`, keyframe or not, with its best pose as known now.
  virtual std::vector<StampedPose2d> trajectory() const = 0;

  /// The map as known now; resolution as configured.
  virtual OccupancyGrid map() const = 0;
};

}  // namespace trident::slam
