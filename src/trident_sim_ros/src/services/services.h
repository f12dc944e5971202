// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <vector>

#include "conversions/conversions.h"
#include "entity_lookup.h"
#include "simulation/simulation.h"

namespace trident::sim {

// The services of gazebo_ros' API plugin under /gazebo, with its status texts, one group per file.
using Servers = std::vector<ros::ServiceServer>;
/// To be served by a queue of its own: a model may take long to read.
void advertise_spawn_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers);
void advertise_delete_service(ros::NodeHandle& node, Simulation& simulation, Servers& servers);
void advertise_state_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers);
/// /gazebo/set_model_state and /gazebo/set_link_state as topics.
void subscribe_state_topics(ros::NodeHandle& node, Simulation& simulation,
                            std::vector<ros::Subscriber>& subscribers);
void advertise_property_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers);
void advertise_force_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers);
/// /gazebo/not_repeatable (std_msgs/String): a node names what made it act by chance.
void subscribe_run_topics(ros::NodeHandle& node, Simulation& simulation,
                          std::vector<ros::Subscriber>& subscribers);
/// /radio/outage; `node` is that of all names.
void advertise_radio_service(ros::NodeHandle& node, Simulation& simulation, Servers& servers);
void advertise_run_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers);

/// Runs `work`; an Error becomes success = false and its text the status message.
template <class Response, class Work>
bool answer(Response& response, const char* failure_prefix, Work&& work) {
  try {
    work();
    response.success = true;
  } catch (const std::exception& error) {
    response.success = false;
    response.status_message = one_line(std::string(failure_prefix) + error.what());
    ROS_ERROR("%s", response.status_message.c_str());
  }
  return true;
}

/// Advertises a service that `work` answers; see answer().
template <class Service, class Work>
void serve(ros::NodeHandle& node, const char* name, const char* failure_prefix, Servers& servers,
           Work work) {
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  servers.push_back(node.advertiseService<Request, Response>(
      name, [failure_prefix, work](Request& request, Response& response) {
        return answer(response, failure_prefix, [&] { work(request, response); });
      }));
}

}  // namespace trident::sim
