// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scan_map.h"
#include "trident_base/yaml_config.h"
#include "trident_slam/slam_2d.h"

namespace trident::slam {

struct OdometrySlam2dParams {
  double resolution = 0.05;
  double range_limit = 20.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("resolution", resolution, Range{0.005, 1.0}, "side of a map cell [m]");
    ar.field("range_limit", range_limit, Range::positive(), "returns beyond it are left out [m]");
  }
};

/// No SLAM at all: odometry's poses and the map that they give. What every algorithm is compared
/// with.
class OdometrySlam2d : public Slam2d {
 public:
  explicit OdometrySlam2d(const OdometrySlam2dParams& params) : params_(params) {}

  ScanPose2d add_scan(const LaserScan& scan, const SE2& T_odom_base) override;
  std::vector<StampedPose2d> trajectory() const override { return trajectory_; }
  OccupancyGrid map() const override;

 private:
  OdometrySlam2dParams params_;
  SE2 T_map_odom_;
  std::vector<LaserScan> scans_;
  std::vector<StampedPose2d> trajectory_;
};

}  // namespace trident::slam
