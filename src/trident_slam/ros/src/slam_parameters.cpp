// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/slam_parameters.h"

#include <XmlRpcValue.h>

#include <sstream>

#include "trident_base/string_util.h"
#include "trident_slam/graph_slam_2d.h"
#include "trident_slam/hector_slam_2d.h"
#include "trident_slam/particle_slam_2d.h"
#include "trident_slam_ros/parameter_names.h"

namespace trident::slam {
namespace {

using XmlRpc::XmlRpcValue;

constexpr char kGraphSlam[] = "graph_slam_2d";

ConfigNode to_config(XmlRpcValue& value) {
  ConfigNode node;
  if (value.getType() == XmlRpcValue::TypeArray) {
    node.kind = ConfigNode::Kind::kSequence;
    for (int i = 0; i < value.size(); ++i) node.items.push_back(to_config(value[i]));
    return node;
  }
  node.kind = ConfigNode::Kind::kScalar;
  if (value.getType() == XmlRpcValue::TypeString) {
    node.scalar = static_cast<std::string>(value);
    node.quoted = true;
  } else if (value.getType() == XmlRpcValue::TypeBoolean) {
    node.scalar = static_cast<bool>(value) ? "true" : "false";
  } else if (value.getType() == XmlRpcValue::TypeInt) {
    node.scalar = std::to_string(static_cast<int>(value));
  } else if (value.getType() == XmlRpcValue::TypeDouble) {
    node.scalar = number_text(static_cast<double>(value));
  } else {
    node.kind = ConfigNode::Kind::kMap;  // no field is one: refused by name
  }
  return node;
}

/// Those fields of a parameter struct that the node has parameters of the same name for.
template <class Params>
Params read_params(const ros::NodeHandle& private_handle) {
  ConfigNode known;
  known.kind = ConfigNode::Kind::kMap;
  for (const std::string& name : field_names<Params>()) {
    XmlRpcValue value;
    if (!private_handle.getParam(name, value)) continue;
    known.keys.push_back(name);
    known.key_lines.push_back(0);
    known.items.push_back(to_config(value));
  }
  return load_config_node<Params>(known, "parameters of " + private_handle.getNamespace());
}

}  // namespace

void read_graph_file(const ros::NodeHandle& private_handle, const std::string& usual,
                     GraphSlamOptions& graph) {
  std::string method = usual;
  std::string config_file;
  private_handle.getParam("method", method);
  private_handle.getParam("config_file", config_file);
  if (method != kGraphSlam || config_file.empty()) return;
  graph = load_yaml<GraphSlamOptions>(config_file);
}

GraphSlamOptions read_graph_options(const ros::NodeHandle& private_handle) {
  auto options = read_params<GraphSlamOptions>(private_handle);
  // A node runs for as long as it likes, and nobody asks it for the places of all scans.
  if (!private_handle.hasParam("keep_scans")) options.keep_scans = false;
  read_graph_file(private_handle, kGraphSlam, options);
  return options;
}

std::function<std::unique_ptr<Slam2d>()> slam_maker(const ros::NodeHandle& private_handle,
                                                    const std::string& usual,
                                                    const GraphSlamOptions& graph,
                                                    const PoseGraphSolverMaker& solver) {
  auto registry = std::make_shared<Registry<Slam2dFactory>>("SLAM method");
  register_builtin_slam_2d(*registry);
  std::string method = usual;
  std::string config_file;
  private_handle.getParam("method", method);
  private_handle.getParam("config_file", config_file);
  registry->get(method);
  if (method == kGraphSlam) {
    return [graph, solver] { return std::make_unique<GraphSlam2d>(graph, solver); };
  }
  if (method == "particle_slam_2d" && config_file.empty()) {
    const auto params = read_params<ParticleSlamParams>(private_handle);
    return [params] { return std::make_unique<ParticleSlam2d>(params); };
  }
  if (method == "hector_slam_2d" && config_file.empty()) {
    const auto params = read_params<HectorSlamParams>(private_handle);
    return [params] { return std::make_unique<HectorSlam2d>(params); };
  }
  return [registry, method, config_file] { return registry->get(method)(config_file); };
}

}  // namespace trident::slam
