// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What links and joints are like, and where joints stand.
#include <gazebo_msgs/GetJointProperties.h>
#include <gazebo_msgs/GetLinkProperties.h>
#include <gazebo_msgs/SetJointProperties.h>
#include <gazebo_msgs/SetLinkProperties.h>
#include <gazebo_msgs/SetModelConfiguration.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "conversions/conversions.h"
#include "services.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

using gazebo_msgs::GetJointProperties;
using gazebo_msgs::GetLinkProperties;
using gazebo_msgs::SetJointProperties;
using gazebo_msgs::SetLinkProperties;
using gazebo_msgs::SetModelConfiguration;

void get_link(Simulation& simulation, const std::string& name,
              GetLinkProperties::Response& response) {
  const Simulation::Access access(simulation);
  const Link& link = required_link(access.world(), name);
  const Eigen::Matrix3d& inertia = link.inertial.inertia_com;
  response.com = to_pose(link.inertial.T_link_com);
  response.gravity_mode = link.gravity;
  response.mass = link.inertial.mass_kg;
  response.ixx = inertia(0, 0), response.iyy = inertia(1, 1), response.izz = inertia(2, 2);
  response.ixy = inertia(0, 1), response.ixz = inertia(0, 2), response.iyz = inertia(1, 2);
  response.status_message = "GetLinkProperties: got properties";
}

void set_link(Simulation& simulation, const SetLinkProperties::Request& request) {
  const Simulation::Access access(simulation);
  Link& link = required_link(access.world(), request.link_name);
  Inertial inertial;
  inertial.mass_kg = request.mass;
  inertial.T_link_com = from_pose(request.com);
  inertial.inertia_com << request.ixx, request.ixy, request.ixz,  //
      request.ixy, request.iyy, request.iyz,                      //
      request.ixz, request.iyz, request.izz;
  access.changed_by("/gazebo/set_link_properties")
      .set_link_inertial(link, inertial, request.gravity_mode);
}

std::uint8_t joint_type(const Joint& joint) {
  // The message has no screw and no gearbox: they turn, as a revolute joint does.
  static const std::map<JointType, std::uint8_t> kKnown{
      {JointType::kFixed, GetJointProperties::Response::FIXED},
      {JointType::kPrismatic, GetJointProperties::Response::PRISMATIC},
      {JointType::kBall, GetJointProperties::Response::BALL},
      {JointType::kUniversal, GetJointProperties::Response::UNIVERSAL}};
  const auto known = kKnown.find(joint.spec.type);
  if (known != kKnown.end()) return known->second;
  const bool has_no_limits = std::isinf(joint.spec.lower) && std::isinf(joint.spec.upper);
  return has_no_limits ? GetJointProperties::Response::CONTINUOUS
                       : GetJointProperties::Response::REVOLUTE;
}

void get_joint(Simulation& simulation, const std::string& name,
               GetJointProperties::Response& response) {
  const Simulation::Access access(simulation);
  const Joint& joint = required_joint(access.world(), name);
  response.type = joint_type(joint);
  for (std::size_t i = 0; i < joint.axis_count(); ++i) {
    response.damping.push_back(joint.axes[i].damping);
    response.position.push_back(joint.position(i));
    response.rate.push_back(joint.velocity(i));
  }
  response.status_message = "GetJointProperties: got properties";
}

/// The entry of an axis, or nothing where the list is shorter.
std::optional<double> entry(const std::vector<double>& values, std::size_t axis) {
  return axis < values.size() ? std::make_optional(values[axis]) : std::nullopt;
}

AxisParams axis_params(const gazebo_msgs::ODEJointProperties& from, std::size_t axis) {
  AxisParams params;
  params.damping = entry(from.damping, axis);
  params.lower = entry(from.loStop, axis);
  params.upper = entry(from.hiStop, axis);
  params.cfm = entry(from.cfm, axis);
  params.stop_erp = entry(from.stop_erp, axis);
  params.stop_cfm = entry(from.stop_cfm, axis);
  params.fudge_factor = entry(from.fudge_factor, axis);
  params.motor_effort = entry(from.fmax, axis);
  params.motor_velocity = entry(from.vel, axis);
  return params;
}

void check_erp(const gazebo_msgs::ODEJointProperties& from, double of_world) {
  // ODE has one error reduction parameter for all
  // joints; another value is refused instead of ignored.
  for (const double erp : from.erp) {
    if (erp == of_world) continue;
    throw Error("erp is " + std::to_string(erp) + ": a joint has none of its own, it is the " +
                "world's " + std::to_string(of_world) + " (set_physics_properties); stop_erp is " +
                "that of its limits");
  }
}

void set_joint(Simulation& simulation, const SetJointProperties::Request& request) {
  const Simulation::Access access(simulation);
  World& world = access.changed_by("/gazebo/set_joint_properties");
  Joint& joint = required_joint(world, request.joint_name);
  const auto& from = request.ode_joint_config;
  check_erp(from, world.physics().erp);
  // The longest list says for how many axes there are values; shorter ones leave the rest as it is.
  std::size_t axes = 0;
  for (const auto* list : {&from.damping, &from.hiStop, &from.loStop, &from.cfm, &from.stop_erp,
                           &from.stop_cfm, &from.fudge_factor, &from.fmax, &from.vel}) {
    axes = std::max(axes, list->size());
  }
  if (axes > joint.axis_count()) {
    throw Error("joint [" + request.joint_name + "] has " + std::to_string(joint.axis_count()) +
                " axes, a property is given for " + std::to_string(axes));
  }
  for (std::size_t i = 0; i < axes; ++i) world.set_axis_params(joint, i, axis_params(from, i));
}

void configure(Simulation& simulation, const SetModelConfiguration::Request& request,
               SetModelConfiguration::Response& response) {
  const Simulation::Access access(simulation);
  Model& model = required_model(access.world(), request.model_name);
  if (request.joint_names.size() != request.joint_positions.size()) {
    throw Error("joint name and position list have different lengths: " +
                std::to_string(request.joint_names.size()) + " and " +
                std::to_string(request.joint_positions.size()));
  }
  std::vector<std::pair<std::string, double>> positions;
  for (std::size_t i = 0; i < request.joint_names.size(); ++i) {
    positions.emplace_back(request.joint_names[i], request.joint_positions[i]);
  }
  const auto clamped =
      access.changed_by("/gazebo/set_model_configuration").set_joint_positions(model, positions);
  response.status_message = "SetModelConfiguration: success";
  for (const std::string& name : clamped) {
    response.status_message += "; [" + name + "] was stopped by its limit";
  }
}

}  // namespace

void advertise_property_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers) {
  serve<GetLinkProperties>(
      node, "get_link_properties", "GetLinkProperties: ", servers,
      [&](auto& request, auto& response) { get_link(simulation, request.link_name, response); });
  serve<SetLinkProperties>(node, "set_link_properties", "SetLinkProperties: ", servers,
                           [&](auto& request, auto& response) {
                             set_link(simulation, request);
                             response.status_message = "SetLinkProperties: properties set";
                           });
  serve<GetJointProperties>(
      node, "get_joint_properties", "GetJointProperties: ", servers,
      [&](auto& request, auto& response) { get_joint(simulation, request.joint_name, response); });
  serve<SetJointProperties>(node, "set_joint_properties", "SetJointProperties: ", servers,
                            [&](auto& request, auto& response) {
                              set_joint(simulation, request);
                              response.status_message = "SetJointProperties: properties set";
                            });
  serve<SetModelConfiguration>(
      node, "set_model_configuration", "SetModelConfiguration: ", servers,
      [&](auto& request, auto& response) { configure(simulation, request, response); });
}

}  // namespace trident::sim
