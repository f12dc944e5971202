// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sensor_msgs/PointCloud2.h>

#include <string>
#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/planning/planner.h"

namespace trident::nav {

/// A potential as navfn publishes it: a point with `pot_value` for each cell that has one, as high
/// as its share of the greatest value, which is at 20 m.
sensor_msgs::PointCloud2 potential_cloud(const std::vector<float>& potential,
                                         const GridGeometry& geometry,
                                         const std_msgs::Header& header);
/// A potential as global_planner publishes it: 0 to `greatest`, -1 where it is unknown.
nav_msgs::OccupancyGrid potential_grid(const std::vector<float>& potential,
                                       const GridGeometry& geometry, int greatest,
                                       const std_msgs::Header& header);

/// The topic `potential` of a planner that keeps one: a cloud for navfn's planners, an occupancy
/// grid for the others, as upstream has them. Computed only while somebody listens.
class PotentialTopic {
 public:
  /// `node`: of the planner's name.
  PotentialTopic(ros::NodeHandle node, const std::string& plugin);

  /// After a plan on a grid of `geometry`, while nobody else plans. nullptr: nothing to publish.
  void publish(const PotentialSource* source, const GridGeometry& geometry,
               const std_msgs::Header& header);

 private:
  bool is_cloud_;
  ros::Publisher publisher_;
};

}  // namespace trident::nav
