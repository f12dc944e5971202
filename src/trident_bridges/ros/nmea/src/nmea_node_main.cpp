// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>

#include "trident_base/error.h"
#include "trident_bridges_ros/nmea/nmea_node.h"
#include "trident_bridges_ros/utc.h"
#include "trident_ros/node_params.h"

int main(int argc, char** argv) {
  using trident::bridges::NmeaNode;
  trident::bridges::init_node(argc, argv, "nmea_node");
  ros::NodeHandle node;
  try {
    trident::ros_utils::NodeParams params(ros::NodeHandle("~"));
    const auto own = trident::bridges::read_nmea_params(params);
    params.log_warnings();
    trident::bridges::NodePollLoop loop;
    loop.follow_clock(node, [](const ros::Time&) {});
    NmeaNode bridge(node, loop, own, trident::UtcClock(trident::bridges::read_utc_start()));
    loop.run();
  } catch (const trident::Error& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
