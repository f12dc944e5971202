// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/node_main.h"
#include "trident_control_ros/vessel_controller_node.h"

int main(int argc, char** argv) {
  return trident::control::run_node(
      argc, argv, "vessel_controller_node",
      [](ros::NodeHandle& node, trident::control::ParameterTree& parameters) {
        const std::string vessel =
            parameters.required_text("vessel", "the path of a vessel's file (config/vessels)");
        const std::string controller = parameters.required_text(
            "controller", "the path of a controller's file (config/controllers)");
        return std::make_unique<trident::control::VesselControllerNode>(
            node, trident::control::load_vessel_model(vessel),
            trident::control::load_vessel_control(controller));
      });
}
