// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sensor_msgs/PointCloud.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "trident_nav/costmap/beam_source.h"
#include "trident_nav/costmap/costmap.h"
#include "trident_nav/costmap/voxel_layer.h"

namespace trident::nav {

/// The voxels of a layer, as costmap_2d/VoxelGrid holds them.
struct VoxelView {
  double stamp_s;
  const std::string& frame;
  const GridGeometry& geometry;
  const VoxelLayerParams& params;
  const std::vector<std::uint32_t>& columns;
};

/// A topic of voxels that is advertised, whatever its type.
struct VoxelPublication {
  ros::Publisher publisher;
  std::function<void(const ros::Publisher& publisher, const VoxelView& voxels)> publish;
};

/// Advertises a topic of voxels. The type of message belongs to a package above this one.
using VoxelAdvertiser =
    std::function<VoxelPublication(ros::NodeHandle& node, const std::string& topic)>;

/// For VoxelGrid: costmap_2d::VoxelGrid.
template <class VoxelGrid>
VoxelAdvertiser voxel_advertiser() {
  return [](ros::NodeHandle& node, const std::string& topic) {
    return VoxelPublication{node.advertise<VoxelGrid>(topic, 1),
                            [](const ros::Publisher& publisher, const VoxelView& voxels) {
                              VoxelGrid message;
                              message.header.frame_id = voxels.frame;
                              message.header.stamp.fromSec(voxels.stamp_s);
                              message.data = voxels.columns;
                              message.origin.x = static_cast<float>(voxels.geometry.origin_x);
                              message.origin.y = static_cast<float>(voxels.geometry.origin_y);
                              message.origin.z = static_cast<float>(voxels.params.origin_z);
                              message.resolutions.x = voxels.geometry.resolution;
                              message.resolutions.y = voxels.geometry.resolution;
                              message.resolutions.z = voxels.params.z_resolution;
                              message.size_x = static_cast<std::uint32_t>(voxels.geometry.width);
                              message.size_y = static_cast<std::uint32_t>(voxels.geometry.height);
                              message.size_z = static_cast<std::uint32_t>(voxels.params.z_voxels);
                              publisher.publish(message);
                            }};
  };
}

/// The topics of a costmap's voxel layers: `LAYER/voxel_grid`, with `publish_voxel_map`, and
/// `LAYER/clearing_endpoints`. Both are made only while somebody listens. The costmap is locked in
/// each call.
class VoxelTopics {
 public:
  /// `node`: of the costmap's name. `costmap` outlives it.
  VoxelTopics(const ros::NodeHandle& node, const Costmap& costmap, std::string frame);

  /// Has `voxel_grid` from now on.
  void advertise_voxels(const VoxelAdvertiser& advertiser);
  /// Takes in where beams of a source of any layer end.
  void note(const BeamSource& source, const Observation& observation);
  /// After an update of the costmap.
  void publish(double now_s);

 private:
  struct Topics {
    VoxelLayer* layer;
    VoxelPublication voxels;
    ros::Publisher endpoints;
    sensor_msgs::PointCloud ends;  ///< Since the last update.
  };

  ros::NodeHandle node_;
  const Costmap& costmap_;
  std::string frame_;
  std::vector<Topics> layers_;
};

}  // namespace trident::nav
