// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <vector>

#include "conversions.h"
#include "simulation.h"

namespace trident {

// The services of gazebo_ros' API plugin under /gazebo, with its status texts, one group per file.
using Servers = std::vector<ros::ServiceServer>;
void advertise_spawn_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers);
void advertise_state_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers);
/// /gazebo/set_model_state and /gazebo/set_link_state as topics.
void subscribe_state_topics(ros::NodeHandle& node, Simulation& simulation,
                            std::vector<ros::Subscriber>& subscribers);
void advertise_force_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers);
void advertise_run_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers);

/// Pose of a reference frame in the world: "", "world", "map" and "/map" are the world; else a
/// model, or a link as "model::link". Throws Error for an unknown name.
struct ReferenceFrame {
  SE3 T_world_frame;
  Eigen::Vector3d v_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_world = Eigen::Vector3d::Zero();
};
ReferenceFrame find_reference_frame(const World& world, const std::string& name);

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

}  // namespace trident
