// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>

#include <memory>
#include <vector>

#include "core/mavros_node.h"
#include "core/vehicle_list.h"
#include "trident_base/error.h"
#include "trident_ros/node_params.h"

int main(int argc, char** argv) {
  using trident::bridges::NodePollLoop;
  trident::bridges::init_node(argc, argv, "mavros");
  ros::NodeHandle node, own("~");
  try {
    trident::ros_utils::NodeParams params(own);
    const auto vehicles = trident::mavros::read_vehicles(params, [](const std::string& name) {
      return trident::ros_utils::NodeParams(ros::NodeHandle(name));
    });
    NodePollLoop loop;
    loop.follow_clock(node, [](const ros::Time& /*now*/) {});
    trident::mavros::Transforms transforms(loop);
    std::vector<std::unique_ptr<trident::mavros::MavrosNode>> bridges;
    for (const auto& [name, values] : vehicles) {
      bridges.push_back(std::make_unique<trident::mavros::MavrosNode>(ros::NodeHandle(name), loop,
                                                                      transforms, values));
      ROS_INFO("mavros: %s: %zu plugins, fcu_url %s, target %d.%d", name.c_str(),
               bridges.back()->plugins(), values.fcu_url.c_str(), values.target_system_id,
               values.target_component_id);
    }
    loop.run();
  } catch (const trident::Error& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
