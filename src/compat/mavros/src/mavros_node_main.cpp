// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>

#include "core/mavros_node.h"
#include "trident_base/error.h"
#include "trident_ros/node_params.h"

int main(int argc, char** argv) {
  using trident::bridges::NodePollLoop;
  trident::bridges::init_node(argc, argv, "mavros");
  ros::NodeHandle node, own("~");
  try {
    trident::ros_utils::NodeParams params(own);
    const auto values = trident::mavros::read_mavros_params(params, own.getNamespace());
    params.log_warnings();
    NodePollLoop loop;
    loop.follow_clock(node, [](const ros::Time& /*now*/) {});
    const trident::mavros::MavrosNode bridge(own, loop, values);
    ROS_INFO("mavros: %zu plugins, fcu_url %s, target %d.%d", bridge.plugins(),
             values.fcu_url.c_str(), values.target_system_id, values.target_component_id);
    loop.run();
  } catch (const trident::Error& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
