// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include "trident_base/error.h"
#include "trident_bridges_ros/modbus/modbus_node_params.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_ros/node_params.h"

namespace trident::bridges::modbus {

/// The main function of a node that is made of a NodeHandle, a loop and ModbusNodeParams. Returns
/// the process's exit code; an Error is logged.
template <class Node>
int run_modbus_node(int argc, char** argv, const char* name) {
  init_node(argc, argv, name);
  ros::NodeHandle node;
  try {
    ros_utils::NodeParams params(ros::NodeHandle("~"));
    const auto own = params.read<ModbusNodeParams>();
    params.log_warnings();
    NodePollLoop loop;
    Node running(node, loop, own);
    loop.run();
  } catch (const Error& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}

}  // namespace trident::bridges::modbus
