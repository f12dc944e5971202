// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/voxel_topics.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace trident::nav {
namespace {

bool has_source(VoxelLayer& layer, const BeamSource& source) {
  const auto& sources = layer.sources();
  return std::any_of(sources.begin(), sources.end(),
                     [&](const BeamSource& one) { return &one == &source; });
}

void append_ends(const Observation& observation, std::vector<geometry_msgs::Point32>* points) {
  for (const BeamGroup& group : observation.groups) {
    const Eigen::Vector3f origin = group.origin.cast<float>();
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
      const Eigen::Vector3f end = origin + observation.ends[i].p;
      geometry_msgs::Point32 point;
      point.x = end.x();
      point.y = end.y();
      point.z = end.z();
      points->push_back(point);
    }
  }
}

}  // namespace

VoxelTopics::VoxelTopics(const ros::NodeHandle& node, const Costmap& costmap, std::string frame)
    : node_(node), costmap_(costmap), frame_(std::move(frame)) {
  for (const auto& layer : costmap.layers()) {
    auto* const voxels = dynamic_cast<VoxelLayer*>(layer.get());
    if (voxels == nullptr) continue;
    const std::string topic = voxels->name() + "/clearing_endpoints";
    layers_.push_back({voxels, {}, node_.advertise<sensor_msgs::PointCloud>(topic, 1), {}});
  }
}

void VoxelTopics::advertise_voxels(const VoxelAdvertiser& advertiser) {
  for (Topics& topics : layers_) {
    topics.voxels = advertiser(node_, topics.layer->name() + "/voxel_grid");
  }
}

void VoxelTopics::note(const BeamSource& source, const Observation& observation) {
  if (!source.params().clearing) return;
  for (Topics& topics : layers_) {
    if (topics.endpoints.getNumSubscribers() == 0 || !has_source(*topics.layer, source)) continue;
    append_ends(observation, &topics.ends.points);
  }
}

void VoxelTopics::publish(double now_s) {
  for (Topics& topics : layers_) {
    if (!topics.ends.points.empty()) {
      topics.ends.header.frame_id = frame_;
      topics.ends.header.stamp.fromSec(now_s);
      topics.endpoints.publish(topics.ends);
      topics.ends.points.clear();
    }
    const VoxelPublication& voxels = topics.voxels;
    if (!voxels.publish || !topics.layer->params().publish_voxel_map) continue;
    if (voxels.publisher.getNumSubscribers() == 0) continue;
    voxels.publish(voxels.publisher, {now_s, frame_, costmap_.grid().geometry,
                                      topics.layer->params(), topics.layer->columns()});
  }
}

}  // namespace trident::nav
