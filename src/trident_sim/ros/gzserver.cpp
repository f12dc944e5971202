// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>

#include <cstdio>

#include "server.h"

namespace {

int serve(const std::vector<std::string>& arguments) {
  const ros::NodeHandle node, private_node("~");
  const trident::ServerOptions options = trident::read_server_options(private_node, arguments);
  if (!ros::param::has("/use_sim_time")) ros::param::set("/use_sim_time", true);
  trident::Server server(node, private_node, options);
  const std::string reason = server.run();
  ROS_INFO("end of the run: %s", reason.c_str());
  ros::shutdown();
  return server.failed() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "gazebo");
  std::vector<std::string> arguments;
  for (int i = 1; i < argc; ++i) arguments.emplace_back(argv[i]);
  try {
    return serve(arguments);
  } catch (const std::exception& error) {
    // Not ROS_FATAL: by now the last node handle has gone, and ROS' log with it.
    std::fprintf(stderr, "[FATAL] gzserver: %s\n", error.what());
    return 1;
  }
}
