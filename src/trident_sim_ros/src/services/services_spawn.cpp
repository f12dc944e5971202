// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gazebo_msgs/DeleteModel.h>
#include <gazebo_msgs/SpawnModel.h>

#include "conversions/conversions.h"
#include "services.h"
#include "trident_base/error.h"
#include "trident_sim/prepared_meshes.h"
#include "trident_sim/sdf_loader.h"

namespace trident::sim {
namespace {

void check_request(const World& world, const gazebo_msgs::SpawnModel::Request& request) {
  if (world.find_model(request.model_name) != nullptr) {
    throw Error("model name " + request.model_name + " already exist.");
  }
  if (request.model_name.empty()) throw Error("model_name is empty");
  if (request.model_xml.empty()) throw Error("model_xml of '" + request.model_name + "' is empty");
}

void report_all(const World& world, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) world.report(Severity::kWarning, warning);
}

/// Reads the model while the world continues: that takes longer than a hundred steps. Warnings come
/// before an error, as from World::spawn().
ModelSpec read_model(Simulation& simulation, const Resources& resources,
                     const gazebo_msgs::SpawnModel::Request& request) {
  std::vector<std::string> warnings;
  const auto warn = [&warnings](const std::string& text) { warnings.push_back(text); };
  try {
    ModelSpec spec = load_model_string(request.model_xml, "model '" + request.model_name + "'",
                                       resources, warn, simulation.odd_elements());
    if (!warnings.empty()) report_all(Simulation::Access(simulation).world(), warnings);
    return spec;
  } catch (const Error&) {
    report_all(Simulation::Access(simulation).world(), warnings);
    throw;
  }
}

/// Text of the response to the caller.
std::string describe(const std::vector<std::string>& all_odd, std::size_t before) {
  const std::string text = "SpawnModel: Successfully spawned entity";
  const std::size_t count = all_odd.size() - before;
  if (count == 0) return text;
  return one_line(text + "; odd elements left out or changed: " + std::to_string(count) +
                  ", the first: " + all_odd[before]);
}

std::string spawn(Simulation& simulation, const Resources& resources,
                  const gazebo_msgs::SpawnModel::Request& request) {
  {
    const Simulation::Access access(simulation);
    check_request(access.world(), request);
    find_reference_frame(access.world(), request.reference_frame);
  }
  ModelSpec spec = read_model(simulation, resources, request);
  const PreparedMeshes meshes(spec);
  const Simulation::Access access(simulation);
  World& world = access.changed_by("the spawning of " + request.model_name);
  check_request(world, request);  // another request may have been faster
  spec.name = request.model_name;
  spec.T_world_model = find_reference_frame(world, request.reference_frame).T_world_frame *
                       from_pose(request.initial_pose);
  const std::size_t odd_before = world.odd_elements().size();
  const auto first = request.robot_namespace.find_first_not_of('/');
  world.spawn(std::move(spec),
              first == std::string::npos ? "" : request.robot_namespace.substr(first));
  simulation.sync_topics();
  return describe(world.odd_elements(), odd_before);
}

/// The caller logs a refusal; /diagnostics keeps it.
std::string spawn_or_note(Simulation& simulation, const Resources& resources,
                          const gazebo_msgs::SpawnModel::Request& request) {
  try {
    return spawn(simulation, resources, request);
  } catch (const Error& error) {
    const Simulation::Access access(simulation);
    access.world().note({Severity::kError,
                         "model '" + request.model_name + "'",
                         "spawn refused",
                         error.what(),
                         {{"namespace", request.robot_namespace}}});
    throw;
  }
}

void remove(Simulation& simulation, const std::string& name) {
  Simulation::Access access(simulation);
  access.changed_by("the removal of " + name).remove(name);
  simulation.sync_topics();
}

}  // namespace

void advertise_spawn_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers) {
  using gazebo_msgs::SpawnModel;
  // Not the world's own: models are read next to it. Loads go one at a time, so sharing is safe.
  const auto resources = std::make_shared<Resources>();
  for (const char* name : {"spawn_urdf_model", "spawn_sdf_model", "spawn_gazebo_model"}) {
    servers.push_back(node.advertiseService<SpawnModel::Request, SpawnModel::Response>(
        name,
        [&simulation, resources](SpawnModel::Request& request, SpawnModel::Response& response) {
          return answer(response, "SpawnModel: Failure - ", [&] {
            response.status_message = spawn_or_note(simulation, *resources, request);
          });
        }));
  }
}

void advertise_delete_service(ros::NodeHandle& node, Simulation& simulation, Servers& servers) {
  using gazebo_msgs::DeleteModel;
  servers.push_back(node.advertiseService<DeleteModel::Request, DeleteModel::Response>(
      "delete_model",
      [&simulation](DeleteModel::Request& request, DeleteModel::Response& response) {
        return answer(response, "DeleteModel: ", [&] {
          remove(simulation, request.model_name);
          response.status_message = "DeleteModel: successfully deleted model";
        });
      }));
}

}  // namespace trident::sim
