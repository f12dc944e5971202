// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// waypoint_publisher_file FILE: once the simulation runs (its first `imu` message) and 30 s of ROS
// time have passed, sends the lines `wait_time x y z yaw_deg` of FILE as one trajectory.
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>

#include <fstream>
#include <stdexcept>

#include "trajectory_sender.h"

namespace {

constexpr double kTimeToReachTheFirstHover_s = 30.0;

std::vector<trident::control::Waypoint> waypoints_of(const std::string& name) {
  std::ifstream file(name);
  if (!file) throw std::runtime_error("file '" + name + "' does not exist or cannot be read");
  return trident::control::read_waypoints(file, "file '" + name + "'");
}

void wait_for_first_imu_message(ros::NodeHandle& node) {
  bool has_come = false;
  const ros::Subscriber imu = node.subscribe<sensor_msgs::Imu>(
      "imu", 10, [&](const sensor_msgs::Imu::ConstPtr&) { has_come = true; });
  ROS_INFO("Wait for simulation to become ready...");
  while (!has_come && ros::ok())
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "waypoint_publisher_file");
  ros::NodeHandle node;
  std::vector<std::string> words;
  ros::removeROSArgs(argc, argv, words);
  if (words.size() != 2) {
    ROS_ERROR("Usage: waypoint_publisher_file <file>; %zu arguments were given", words.size() - 1);
    return 1;
  }
  try {
    const std::vector<trident::control::Waypoint> waypoints = waypoints_of(words[1]);
    ROS_INFO("Read %zu waypoints.", waypoints.size());
    trident::control::TrajectorySender sender(node);
    wait_for_first_imu_message(node);
    if (!trident::control::wait_for(kTimeToReachTheFirstHover_s)) return 1;
    return sender.send(trident::control::trajectory_through(waypoints)) ? 0 : 1;
  } catch (const std::runtime_error& error) {
    ROS_ERROR("waypoint_publisher_file: %s", error.what());
    return 1;
  }
}
