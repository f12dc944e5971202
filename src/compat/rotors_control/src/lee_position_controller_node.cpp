// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/lee_position_controller_node.h"

#include "trident_control_ros/controller_params.h"
#include "trident_control_ros/node_main.h"

int main(int argc, char** argv) {
  return trident::control::run_node(
      argc, argv, "lee_position_controller_node",
      [](ros::NodeHandle& node, trident::ros_utils::NodeParams& params) {
        const auto own = params.read<trident::control::LeeNodeParams>();
        return std::make_unique<trident::control::LeePositionControllerNode>(node, own.controller(),
                                                                             own.setpoints);
      });
}
