// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <ros/ros.h>

#include <cstdio>

#include "server_options.h"
#include "services.h"
#include "simulation.h"

namespace {

/// Services are answered by threads of their own: one may wait for steps while others are asked.
constexpr std::uint32_t kServiceThreads = 4;

int serve(const std::vector<std::string>& arguments) {
  ros::NodeHandle node;
  ros::NodeHandle private_node("~");
  const trident::ServerOptions options = trident::read_server_options(arguments);
  if (!ros::param::has("/use_sim_time")) ros::param::set("/use_sim_time", true);
  trident::Simulation simulation(node, options);
  trident::Servers servers;
  std::vector<ros::Subscriber> subscribers;
  trident::subscribe_state_topics(private_node, simulation, subscribers);
  trident::advertise_state_services(private_node, simulation, servers);
  trident::advertise_force_services(private_node, simulation, servers);
  trident::advertise_run_services(private_node, simulation, servers);
  trident::advertise_spawn_services(private_node, simulation, servers);
  ros::AsyncSpinner spinner(kServiceThreads);
  spinner.start();
  const std::string reason = simulation.run();
  ROS_INFO("end of the run: %s", reason.c_str());
  ros::shutdown();
  spinner.stop();
  return 0;
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
