// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// trajectory_optimizer_node: the service optimize_trajectories.
#include <ros/ros.h>

#include "trident_ros/message_checks.h"
#include "trident_ros/refusals.h"
#include "trident_trajectories_ros/trajectory_request.h"

int main(int argc, char** argv) {
  using Service = trident_msgs::OptimizeTrajectories;
  ros::init(argc, argv, "trajectory_optimizer");
  ros::NodeHandle node;
  trident::ros_utils::Refusals refusals(node);
  const boost::function<bool(Service::Request&, Service::Response&)> serve =
      [&](Service::Request& request, Service::Response& response) {
        bool is_refused = false;
        response = trident::trajectories::answer(request, is_refused);
        if (is_refused)
          refusals.note("optimize_trajectories", trident::ros_utils::quoted(response.message));
        return true;
      };
  const ros::ServiceServer server = node.advertiseService("optimize_trajectories", serve);
  ros::spin();
}
