// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>

#include <functional>

#include "trident_estimation_ros/amcl_node_params.h"

namespace trident::estimation {

/// Where the map comes from: the topic `map`, or the service `static_map`, which is asked until it
/// answers; the service `set_map` replaces it at any time.
class AmclMapInput {
 public:
  /// Returns false for a map that cannot be used.
  using OnMap = std::function<bool(const nav_msgs::OccupancyGrid&)>;
  /// The pose that came with a map of `set_map`.
  using OnPose = std::function<void(const geometry_msgs::PoseWithCovarianceStamped&)>;

  /// The functions are called by the thread that spins.
  AmclMapInput(ros::NodeHandle& node, const AmclNodeParams& params, OnMap on_map, OnPose on_pose);

 private:
  void take(const nav_msgs::OccupancyGrid& message);
  void poll_static_map();

  OnMap on_map_;
  OnPose on_pose_;
  bool has_map_ = false;  ///< One was usable.
  ros::Subscriber topic_;
  ros::ServiceServer set_map_;
  ros::ServiceClient static_map_;
  ros::WallTimer timer_;
};

}  // namespace trident::estimation
