// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/lee_position_controller_node.h"

#include "trident_control_ros/node_main.h"

int main(int argc, char** argv) {
  return trident::control::run_node(
      argc, argv, "lee_position_controller_node",
      [](ros::NodeHandle& node, trident::control::ParameterTree& parameters) {
        const trident::control::LeeParams params = parameters.lee_params();
        return std::make_unique<trident::control::LeePositionControllerNode>(
            node, params, parameters.setpoint_queue_params());
      });
}
