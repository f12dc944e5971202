// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// waypoint_publisher X Y Z YAW_DEG [DELAY]: sends one vehicle to a point after DELAY (default 1) s
// of ROS time.
#include <ros/ros.h>

#include <stdexcept>

#include "trajectory_sender.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "waypoint_publisher");
  ros::NodeHandle node;
  std::vector<std::string> words;
  ros::removeROSArgs(argc, argv, words);
  words.erase(words.begin());
  if (words.size() != 4 && words.size() != 5) {
    ROS_ERROR("Usage: waypoint_publisher <x> <y> <z> <yaw_deg> [delay]; %zu arguments were given",
              words.size());
    return 1;
  }
  try {
    const trident::control::Waypoint goal = trident::control::waypoint_from_words(words);
    const double delay_s =
        words.size() == 5 ? trident::control::parse_wait(words[4], "delay") : 1.0;
    trident::control::TrajectorySender sender(node);
    if (!trident::control::wait_for(delay_s)) return 1;
    return sender.send(trident::control::trajectory_through({goal})) ? 0 : 1;
  } catch (const std::runtime_error& error) {
    ROS_ERROR("waypoint_publisher: %s", error.what());
    return 1;
  }
}
