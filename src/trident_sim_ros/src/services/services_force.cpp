// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gazebo_msgs/ApplyBodyWrench.h>
#include <gazebo_msgs/ApplyJointEffort.h>
#include <gazebo_msgs/BodyRequest.h>
#include <gazebo_msgs/JointRequest.h>

#include "conversions/conversions.h"
#include "services.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

using gazebo_msgs::ApplyBodyWrench;
using gazebo_msgs::ApplyJointEffort;
using gazebo_msgs::BodyRequest;
using gazebo_msgs::JointRequest;

/// In the world's frame the wrench acts at the body's centre of mass plus reference_point, in
/// another frame at reference_point of that frame; axes are the frame's.
void apply_body_wrench(Simulation& simulation, const ApplyBodyWrench::Request& request) {
  Simulation::Access access(simulation);
  World& world = access.changed_by("/gazebo/apply_body_wrench");
  Link& link = required_body(world, request.body_name);
  const ReferenceFrame frame = find_reference_frame(world, request.reference_frame);
  const std::string& name = request.reference_frame;
  const bool in_world = name.empty() || name == "world" || name == "map" || name == "/map";
  const Eigen::Vector3d point = from_point(request.reference_point);
  const Eigen::Vector3d p_world =
      in_world ? Eigen::Vector3d(link.p_world_com() + point) : frame.T_world_frame * point;
  world.apply_wrench({&link, frame.T_world_frame.R * from_vector(request.wrench.force),
                      frame.T_world_frame.R * from_vector(request.wrench.torque),
                      link.T_world_link().inverse() * p_world, from_ros(request.start_time),
                      from_ros(request.duration)});
}

void apply_joint_effort(Simulation& simulation, const ApplyJointEffort::Request& request) {
  Simulation::Access access(simulation);
  Joint& joint = required_joint(access.world(), request.joint_name);
  access.changed_by("/gazebo/apply_joint_effort")
      .apply_effort(
          {&joint, request.effort, from_ros(request.start_time), from_ros(request.duration)});
}

}  // namespace

void advertise_force_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers) {
  serve<ApplyBodyWrench>(node, "apply_body_wrench", "ApplyBodyWrench: ", servers,
                         [&](auto& request, auto&) { apply_body_wrench(simulation, request); });
  serve<ApplyJointEffort>(node, "apply_joint_effort", "ApplyJointEffort: ", servers,
                          [&](auto& request, auto& response) {
                            apply_joint_effort(simulation, request);
                            response.status_message = "ApplyJointEffort: effort set";
                          });
  servers.push_back(node.advertiseService<BodyRequest::Request, BodyRequest::Response>(
      "clear_body_wrenches", [&](BodyRequest::Request& request, BodyRequest::Response&) {
        Simulation::Access access(simulation);
        const Link* link = access.world().find_link(request.body_name);
        if (link == nullptr) {
          ROS_ERROR("ClearBodyWrenches: body [%s] does not exist",
                    one_line(request.body_name).c_str());
        } else {
          access.changed_by("/gazebo/clear_body_wrenches").clear_wrenches(*link);
        }
        return link != nullptr;
      }));
  for (const char* name : {"clear_joint_forces", "clear_joint_efforts"}) {
    servers.push_back(node.advertiseService<JointRequest::Request, JointRequest::Response>(
        name, [&](JointRequest::Request& request, JointRequest::Response&) {
          try {
            Simulation::Access access(simulation);
            const Joint& joint = required_joint(access.world(), request.joint_name);
            access.changed_by("/gazebo/clear_joint_forces").clear_efforts(joint);
            return true;
          } catch (const Error& error) {
            ROS_ERROR("ClearJointForces: %s", one_line(error.what()).c_str());
            return false;
          }
        }));
  }
}

}  // namespace trident::sim
