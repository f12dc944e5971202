// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>

#include <cstdio>
#include <iostream>
#include <iterator>

#include "server.h"
#include "trident_sim/sdf_loader.h"

namespace {

int serve(const std::vector<std::string>& arguments) {
  const ros::NodeHandle node, private_node("~");
  const trident::sim::ServerOptions options =
      trident::sim::read_server_options(private_node, arguments);
  if (!ros::param::has("/use_sim_time")) ros::param::set("/use_sim_time", true);
  trident::sim::Server server(node, private_node, options);
  const std::string reason = server.run();
  ROS_INFO("end of the run: %s", reason.c_str());
  ros::shutdown();
  return server.failed() ? 1 : 0;
}

/// Looks at what it would be started with, and at the world file: the private parameters come as
/// XML-RPC on standard input, since there is no master yet.
int check(const std::vector<std::string>& arguments) {
  const std::string text(std::istreambuf_iterator<char>(std::cin), {});
  const auto begin = text.find("<value>");
  XmlRpc::XmlRpcValue parameters;
  if (begin != std::string::npos) {
    int offset = static_cast<int>(begin);
    parameters.fromXml(text, &offset);
  }
  const trident::sim::ServerOptions options =
      trident::sim::server_options_of("/gazebo", parameters, arguments);
  trident::sim::load_world_file(options.world_file, trident::sim::Resources(),
                                [](const std::string&) {});
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const bool only_checks = argc > 1 && std::string(argv[1]) == "--check";
  if (!only_checks) ros::init(argc, argv, "gazebo");
  try {
    return only_checks ? check({argv + 2, argv + argc}) : serve({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    // Not ROS_FATAL: by now the last node handle has gone, and ROS' log with it.
    std::fprintf(stderr, "[FATAL] gzserver: %s\n", error.what());
    return 1;
  }
}
