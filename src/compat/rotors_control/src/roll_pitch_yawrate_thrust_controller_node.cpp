// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/roll_pitch_yawrate_thrust_controller_node.h"

#include "trident_control_ros/controller_params.h"
#include "trident_control_ros/node_main.h"

int main(int argc, char** argv) {
  return trident::control::run_node(
      argc, argv, "roll_pitch_yawrate_thrust_controller_node",
      [](ros::NodeHandle& node, trident::ros_utils::NodeParams& params) {
        const auto own = params.read<trident::control::RollPitchYawrateThrustNodeParams>();
        return std::make_unique<trident::control::RollPitchYawrateThrustControllerNode>(
            node, own.controller());
      });
}
