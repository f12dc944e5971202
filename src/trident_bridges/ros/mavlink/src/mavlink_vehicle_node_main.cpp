// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>

#include "trident_base/error.h"
#include "trident_bridges_ros/mavlink/mavlink_fleet_node.h"
#include "trident_ros/node_params.h"

int main(int argc, char** argv) {
  using namespace trident::bridges;  // NOLINT: of a program's main file
  init_node(argc, argv, "mavlink_vehicle_node");
  ros::NodeHandle node;
  try {
    const auto params = trident::ros_utils::load_params<MavlinkNodeParams>(ros::NodeHandle("~"));
    NodePollLoop loop;
    const MavlinkFleetNode fleet(node, loop, params);
    loop.run();
  } catch (const trident::Error& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
