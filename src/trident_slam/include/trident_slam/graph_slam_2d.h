// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "trident_slam/graph_slam_options.h"
#include "trident_slam/slam_2d.h"

namespace trident {

/// Graph SLAM: each scan is matched against the surfaces of the map so far; keyframes and the
/// measurements between them form a graph; loops are found by branch and bound and believed when
/// several of them agree; at the end every scan is matched against the map once more.
class GraphSlam2d : public Slam2d {
 public:
  explicit GraphSlam2d(const GraphSlamOptions& options = {});
  ~GraphSlam2d() override;

  ScanPose2d add_scan(const LaserScan& scan, const SE2& T_odom_base) override;
  void finish() override;
  std::vector<StampedPose2d> trajectory() const override;
  OccupancyGrid map() const override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trident
