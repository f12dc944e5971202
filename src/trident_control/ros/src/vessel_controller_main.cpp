// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/controller_params.h"
#include "trident_control_ros/node_main.h"
#include "trident_control_ros/vessel_controller_node.h"

int main(int argc, char** argv) {
  return trident::control::run_node(
      argc, argv, "vessel_controller_node",
      [](ros::NodeHandle& node, trident::ros_utils::NodeParams& params) {
        const auto own = params.read<trident::control::VesselNodeParams>();
        return std::make_unique<trident::control::VesselControllerNode>(
            node, trident::control::load_vessel_model(own.vessel),
            trident::control::load_vessel_control(own.controller));
      });
}
