// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/GetMap.h>
#include <ros/ros.h>

#include <functional>
#include <string>

#include "trident_slam_ros/background_task.h"
#include "trident_slam_ros/guarded_slam.h"
#include "trident_slam_ros/map_publisher.h"
#include "trident_slam_ros/slam_node_options.h"

namespace trident::slam {

/// The map of a node: on its topics when it is due, drawn in a thread of its own, and as the
/// service dynamic_map.
class MapServer {
 public:
  using OnProblem = std::function<void(const std::string& problem)>;

  /// `own`: serves dynamic_map, which may take long. `on_problem` is called with problems, in any
  /// thread. `slam` must outlive it.
  MapServer(ros::NodeHandle node, ros::NodeHandle own, const SlamNodeOptions& options,
            GuardedSlam& slam, OnProblem on_problem);

  /// Begins to draw and publish the map if it is due at `now` and none is being drawn.
  void publish_if_due(const ros::Time& now);
  /// The map as it is now.
  nav_msgs::OccupancyGrid message() { return to_message(slam_.map_snapshot()()); }

 private:
  nav_msgs::OccupancyGrid to_message(const OccupancyGrid& map) const;
  bool get_map(nav_msgs::GetMap::Request& request, nav_msgs::GetMap::Response& response);

  std::string frame_;
  GuardedSlam& slam_;
  OnProblem on_problem_;
  MapPublisher publisher_;
  BackgroundTask task_;
  ros::ServiceServer service_;
};

}  // namespace trident::slam
