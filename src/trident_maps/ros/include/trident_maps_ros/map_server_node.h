// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/GetMap.h>
#include <nav_msgs/LoadMap.h>
#include <ros/ros.h>

#include <string>

#include "trident_ros/diagnostic_counter.h"

namespace trident::maps {

/// map_server: the map of a file on the latched topics `map` and `map_metadata` and by the service
/// `static_map`; `change_map` replaces it by that of another file, and keeps the old one when that
/// cannot be read, which counts in /diagnostics. Private parameter `frame_id` (map).
class MapServerNode {
 public:
  /// Throws MapFileError.
  MapServerNode(ros::NodeHandle& node, const ros::NodeHandle& private_node,
                const std::string& yaml_path);

 private:
  void load(const std::string& yaml_path);
  bool on_change_map(nav_msgs::LoadMap::Request& request, nav_msgs::LoadMap::Response& response);

  std::string frame_;
  nav_msgs::OccupancyGrid map_;
  ros::Publisher map_publisher_, metadata_publisher_, diagnostics_publisher_;
  ros_utils::DiagnosticCounter problems_;
  ros::ServiceServer static_map_, change_map_;
};

/// map_server's command line: `map_server map.yaml`. Returns the exit code.
int map_server_main(int argc, char** argv);

/// map_saver's: `map_saver [--occ N] [--free N] [-f NAME] [map:=TOPIC]` waits for a map, writes
/// NAME.pgm and NAME.yaml and ends. Returns the exit code.
int map_saver_main(int argc, char** argv);

}  // namespace trident::maps
