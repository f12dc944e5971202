// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gazebo_msgs/GetLinkState.h>
#include <gazebo_msgs/GetModelProperties.h>
#include <gazebo_msgs/GetModelState.h>
#include <gazebo_msgs/GetWorldProperties.h>
#include <gazebo_msgs/SetLinkState.h>
#include <gazebo_msgs/SetModelState.h>

#include "conversions/conversions.h"
#include "services.h"
#include "trident_base/error.h"
#include "trident_ros/refusals.h"
#include "trident_sim/motion_limits.h"

namespace trident::sim {
namespace {

using gazebo_msgs::GetLinkState;
using gazebo_msgs::GetModelProperties;
using gazebo_msgs::GetModelState;
using gazebo_msgs::GetWorldProperties;
using gazebo_msgs::SetLinkState;
using gazebo_msgs::SetModelState;

/// Pose and twist of a point that moves with `link`, seen from `frame`.
void fill(const Link* link, const SE3& T_world_body, const ReferenceFrame& frame,
          geometry_msgs::Pose& pose, geometry_msgs::Twist& twist) {
  // Velocities are relative to the frame's own motion, in its axes.
  const Eigen::Quaterniond R_frame_world = frame.T_world_frame.R.conjugate();
  pose = to_pose(frame.T_world_frame.inverse() * T_world_body);
  if (link == nullptr) return;
  twist.linear = to_vector(R_frame_world * (link->v_world_at(T_world_body.p) - frame.v_world));
  twist.angular = to_vector(R_frame_world * (link->w_world() - frame.w_world));
}

void get_model_state(Simulation& simulation, const GetModelState::Request& request,
                     GetModelState::Response& response) {
  Simulation::Access access(simulation);
  const World& world = access.world();
  const Model& model = required_model(world, request.model_name);
  const ReferenceFrame frame = find_reference_frame(world, request.relative_entity_name);
  response.header.stamp = to_ros(world.time());
  response.header.frame_id = request.relative_entity_name;
  fill(model.canonical_link(), model.T_world_model(), frame, response.pose, response.twist);
  response.status_message = "GetModelState: got properties";
}

void set_model_state(Simulation& simulation, const gazebo_msgs::ModelState& state) {
  Simulation::Access access(simulation);
  World& world = access.changed_by("/gazebo/set_model_state");
  Model& model = required_model(world, state.model_name);
  const SE3 T_world_frame = find_reference_frame(world, state.reference_frame).T_world_frame;
  const Eigen::Vector3d v_world = T_world_frame.R * from_vector(state.twist.linear);
  const Eigen::Vector3d w_world = T_world_frame.R * from_vector(state.twist.angular);
  // Before anything is done: a state is set as a whole, or refused.
  if (!is_motion(v_world, w_world)) {
    throw Error("twist of model [" + state.model_name +
                "] is not finite, or beyond 1e5 m/s or 1e4 rad/s");
  }
  world.set_model_pose(model, T_world_frame * from_pose(state.pose));
  world.set_model_twist(model, v_world, w_world);
}

void get_link_state(Simulation& simulation, const GetLinkState::Request& request,
                    GetLinkState::Response& response) {
  Simulation::Access access(simulation);
  const World& world = access.world();
  const Link& link = required_link(world, request.link_name);
  response.link_state.link_name = request.link_name;
  response.link_state.reference_frame = request.reference_frame;
  fill(&link, link.T_world_link(), find_reference_frame(world, request.reference_frame),
       response.link_state.pose, response.link_state.twist);
  response.status_message = "GetLinkState: got state";
}

void set_link_state(Simulation& simulation, const gazebo_msgs::LinkState& state) {
  Simulation::Access access(simulation);
  World& world = access.changed_by("/gazebo/set_link_state");
  Link* link = world.find_link(state.link_name);
  if (link == nullptr) throw Error("link does not exist: [" + state.link_name + "]");
  const SE3 T_world_frame = find_reference_frame(world, state.reference_frame).T_world_frame;
  world.set_link_state(*link, T_world_frame * from_pose(state.pose),
                       T_world_frame.R * from_vector(state.twist.linear),
                       T_world_frame.R * from_vector(state.twist.angular));
}

void get_model_properties(Simulation& simulation, const std::string& name,
                          GetModelProperties::Response& response) {
  Simulation::Access access(simulation);
  const Model& model = required_model(access.world(), name);
  for (const auto& link : model.links) response.body_names.push_back(link->name);
  for (const auto& joint : model.joints) response.joint_names.push_back(joint->spec.name);
  for (const LinkSpec& link : model.spec.links) {
    for (const CollisionSpec& collision : link.collisions) {
      response.geom_names.push_back(collision.name);
    }
  }
  if (model.canonical_link() != nullptr) {
    response.canonical_body_name = model.canonical_link()->name;
  }
  response.is_static = model.is_static;
  response.status_message = "GetModelProperties: got properties";
}

void get_world_properties(Simulation& simulation, GetWorldProperties::Response& response) {
  Simulation::Access access(simulation);
  response.sim_time = access.world().time().seconds();
  for (const auto& [name, model] : access.world().models()) response.model_names.push_back(name);
  // There is no rendering engine; cameras are drawn by ray casting.
  response.rendering_enabled = false;
  response.status_message = "GetWorldProperties: got properties";
}

/// A topic form of a set_ service: refusals are logged every few seconds, as there is no response.
template <class State, class Set>
auto logged(Simulation& simulation, const std::shared_ptr<ros_utils::Refusals>& refusals,
            const char* what, Set set) {
  return [&simulation, refusals, what, set](const State& state) {
    try {
      set(simulation, state);
    } catch (const Error& error) {
      refusals->note(std::string(what) + " refused",
                     one_line(std::string(what) + ": " + error.what()));
    }
  };
}

}  // namespace

void advertise_state_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers) {
  serve<GetModelState>(
      node, "get_model_state", "GetModelState: ", servers,
      [&](auto& request, auto& response) { get_model_state(simulation, request, response); });
  serve<SetModelState>(node, "set_model_state", "SetModelState: ", servers,
                       [&](auto& request, auto& response) {
                         set_model_state(simulation, request.model_state);
                         response.status_message = "SetModelState: set model state done";
                       });
  serve<GetLinkState>(
      node, "get_link_state", "GetLinkState: ", servers,
      [&](auto& request, auto& response) { get_link_state(simulation, request, response); });
  serve<SetLinkState>(node, "set_link_state", "SetLinkState: ", servers,
                      [&](auto& request, auto& response) {
                        set_link_state(simulation, request.link_state);
                        response.status_message = "SetLinkState: success";
                      });
  serve<GetModelProperties>(node, "get_model_properties", "GetModelProperties: ", servers,
                            [&](auto& request, auto& response) {
                              get_model_properties(simulation, request.model_name, response);
                            });
  serve<GetWorldProperties>(
      node, "get_world_properties", "GetWorldProperties: ", servers,
      [&](auto&, auto& response) { get_world_properties(simulation, response); });
}

void subscribe_state_topics(ros::NodeHandle& node, Simulation& simulation,
                            std::vector<ros::Subscriber>& subscribers) {
  const auto refusals = std::make_shared<ros_utils::Refusals>(node);
  subscribers.push_back(node.subscribe<gazebo_msgs::ModelState>(
      "set_model_state", 10,
      boost::function<void(const gazebo_msgs::ModelState&)>(logged<gazebo_msgs::ModelState>(
          simulation, refusals, "set_model_state", set_model_state))));
  subscribers.push_back(node.subscribe<gazebo_msgs::LinkState>(
      "set_link_state", 10,
      boost::function<void(const gazebo_msgs::LinkState&)>(
          logged<gazebo_msgs::LinkState>(simulation, refusals, "set_link_state", set_link_state))));
}

}  // namespace trident::sim
