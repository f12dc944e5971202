// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// Starts the simulation, and sends one vehicle to the point of its private parameters x, y, z [m],
// yaw [rad].
#include <ros/ros.h>
#include <std_srvs/Empty.h>

#include <chrono>
#include <thread>

#include "trajectory_sender.h"

namespace {

constexpr int kTries = 10;
constexpr double kTimeForTheWorldToSettle_s = 5.0;  // simulated

bool unpause_physics() {
  std_srvs::Empty request;
  for (int i = 0; i <= kTries && ros::ok(); ++i) {
    if (ros::service::call("/gazebo/unpause_physics", request)) return true;
    ROS_INFO("Wait for 1 second before trying to unpause Gazebo again.");
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "hovering_example");
  ros::NodeHandle node;
  const ros::NodeHandle private_node("~");
  trident::control::TrajectorySender sender(node);
  ROS_INFO("Started hovering example.");
  if (!unpause_physics()) {
    ROS_FATAL("Could not wake up Gazebo.");
    return 1;
  }
  ROS_INFO("Unpaused the Gazebo simulation.");

  trident::control::Waypoint goal;
  private_node.param("x", goal.x, 0.0);
  private_node.param("y", goal.y, 0.0);
  private_node.param("z", goal.z, 1.0);
  private_node.param("yaw", goal.yaw, 0.0);
  if (!trident::control::wait_for(kTimeForTheWorldToSettle_s)) return 1;
  return sender.send(trident::control::trajectory_through({goal})) ? 0 : 1;
}
