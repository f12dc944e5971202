// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gazebo_msgs/DeleteModel.h>
#include <gazebo_msgs/SpawnModel.h>

#include "conversions.h"
#include "services.h"
#include "trident_base/error.h"

namespace trident {
namespace {

void spawn(Simulation& simulation, const gazebo_msgs::SpawnModel::Request& request) {
  Simulation::Access access(simulation);
  World& world = access.world();
  if (world.find_model(request.model_name) != nullptr) {
    throw Error("model name " + request.model_name + " already exist.");
  }
  if (request.model_name.empty()) throw Error("model_name is empty");
  if (request.model_xml.empty()) throw Error("model_xml of '" + request.model_name + "' is empty");
  SpawnRequest spawn;
  spawn.name = request.model_name;
  spawn.xml = request.model_xml;
  spawn.robot_namespace = request.robot_namespace;
  const auto first = spawn.robot_namespace.find_first_not_of('/');
  spawn.robot_namespace = first == std::string::npos ? "" : spawn.robot_namespace.substr(first);
  spawn.T_world_model = find_reference_frame(world, request.reference_frame).T_world_frame *
                        from_pose(request.initial_pose);
  world.spawn(spawn);
  simulation.sync_topics();
}

void remove(Simulation& simulation, const std::string& name) {
  Simulation::Access access(simulation);
  access.world().remove(name);
  simulation.sync_topics();
}

}  // namespace

ReferenceFrame find_reference_frame(const World& world, const std::string& name) {
  if (name.empty() || name == "world" || name == "map" || name == "/map") return {};
  const Model* model = world.find_model(name);
  const Link* link = model != nullptr ? model->canonical_link() : world.find_link(name);
  if (link == nullptr) {
    throw Error("reference frame '" + name + "' is not world, a model or a link (model::link)");
  }
  const SE3 T = model != nullptr ? model->T_world_model() : link->T_world_link();
  return {T, link->v_world_at(T.p), link->w_world()};
}

void advertise_spawn_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers) {
  using gazebo_msgs::DeleteModel;
  using gazebo_msgs::SpawnModel;
  for (const char* name : {"spawn_urdf_model", "spawn_sdf_model", "spawn_gazebo_model"}) {
    servers.push_back(node.advertiseService<SpawnModel::Request, SpawnModel::Response>(
        name, [&simulation](SpawnModel::Request& request, SpawnModel::Response& response) {
          return answer(response, "SpawnModel: Failure - ", [&] {
            spawn(simulation, request);
            response.status_message = "SpawnModel: Successfully spawned entity";
          });
        }));
  }
  servers.push_back(node.advertiseService<DeleteModel::Request, DeleteModel::Response>(
      "delete_model",
      [&simulation](DeleteModel::Request& request, DeleteModel::Response& response) {
        return answer(response, "DeleteModel: ", [&] {
          remove(simulation, request.model_name);
          response.status_message = "DeleteModel: successfully deleted model";
        });
      }));
}

}  // namespace trident
