// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/run_program.h"

#include <ros/ros.h>

#include <exception>
#include <iostream>

namespace trident::slam {

int run_program(int argc, char** argv, const std::string& name, const std::function<void()>& run) {
  ros::init(argc, argv, name);
  try {
    run();
  } catch (const std::exception& error) {
    std::cerr << ros::this_node::getName() << ": " << error.what() << std::endl;
    return 1;
  }
  return 0;
}

}  // namespace trident::slam
