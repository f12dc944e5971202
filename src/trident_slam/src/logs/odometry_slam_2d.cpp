// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "odometry_slam_2d.h"

#include "trident_slam/slam_2d_factory.h"

namespace trident::slam {

ScanPose2d OdometrySlam2d::add_scan(const LaserScan& scan, const SE2& T_odom_base) {
  if (scans_.empty()) T_map_odom_ = T_odom_base.inverse();
  scans_.push_back(scan);
  ScanPose2d result;
  result.T_map_base = T_map_odom_ * T_odom_base;
  trajectory_.push_back({scan.stamp_ns, result.T_map_base});
  return result;
}

OccupancyGrid OdometrySlam2d::map() const {
  ScanMapOptions options;
  options.resolution = params_.resolution;
  options.range_limit = params_.range_limit;
  const auto placed = [this](std::size_t k) {
    return PlacedScan{&scans_[k], trajectory_[k].T_map_base};
  };
  return build_scan_map(scans_.size(), placed, options);
}

TRIDENT_SLAM_2D_METHOD(odometry_slam_2d, "odometry", OdometrySlam2d, OdometrySlam2dParams)

}  // namespace trident::slam
