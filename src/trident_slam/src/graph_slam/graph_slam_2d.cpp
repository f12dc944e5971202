// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/graph_slam_2d.h"

#include "graph_slam/graph_mapper.h"
#include "graph_slam/keyframe_map.h"

namespace trident {

class GraphSlam2d::Impl {
 public:
  explicit Impl(const GraphSlamOptions& options) : options(options), mapper(options) {}
  GraphSlamOptions options;
  GraphMapper mapper;
};

GraphSlam2d::GraphSlam2d(const GraphSlamOptions& options)
    : impl_(std::make_unique<Impl>(options)) {}

GraphSlam2d::~GraphSlam2d() = default;

ScanPose2d GraphSlam2d::add_scan(const LaserScan& scan, const SE2& T_odom_base) {
  return impl_->mapper.add_scan(scan, T_odom_base);
}

void GraphSlam2d::finish() { impl_->mapper.finish(); }

std::vector<StampedPose2d> GraphSlam2d::trajectory() const { return impl_->mapper.trajectory(); }

OccupancyGrid GraphSlam2d::map() const {
  return keyframe_map(impl_->mapper.graph(), impl_->options.resolution);
}

}  // namespace trident
