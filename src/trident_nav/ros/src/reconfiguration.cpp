// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/reconfiguration.h"

#include <algorithm>
#include <utility>

#include "trident_base/error.h"
#include "trident_nav/costmap/costmap_config.h"

namespace trident::nav {
namespace {

ConfigNode map_of(const ConfigNode* node) {
  ConfigNode map;
  map.kind = ConfigNode::Kind::kMap;
  return node != nullptr && node->kind == ConfigNode::Kind::kMap ? *node : map;
}

/// Of those that a struct has, the values that a map gives; other keys of the map are left out.
ConfigNode only_fields(const ConfigNode& map, const std::vector<ConfigField>& fields) {
  ConfigNode result = map_of(nullptr);
  for (const ConfigField& field : fields) {
    const std::string key = field.name.substr(0, field.name.find('/'));
    const ConfigNode* const value = map.find(key);
    if (value == nullptr || result.find(key) != nullptr) continue;
    result.keys.push_back(key);
    result.key_lines.push_back(0);
    result.items.push_back(*value);
  }
  return result;
}

void require_same_plugin(const char* key, const std::string& now, const std::string& wanted) {
  if (now == wanted) return;
  throw Error(std::string(key) + " = '" + wanted + "' takes effect when the node starts; it is '" +
              now + "'");
}

}  // namespace

Reconfiguration::Reconfiguration(const ros::NodeHandle& private_node, MoveBaseParts& parts,
                                 ros_utils::Refusals& refusals)
    : node_(private_node),
      parts_(parts),
      refusals_(refusals),
      params_(parts.params),
      control_(parts.control) {
  serve_node();
  serve_planner();
  serve_controller();
  serve_costmap(*parts.global, "global_costmap");
  serve_costmap(*parts.local, "local_costmap");
  parts.local->set_footprint_listener([this] { change_footprint(); });
}

void Reconfiguration::add_server(const std::string& name_space,
                                 const std::vector<ConfigField>& fields, const ConfigNode& values,
                                 ros_utils::ReconfigureServer::Apply apply) {
  if (fields.empty()) return;
  servers_.push_back(std::make_unique<ros_utils::ReconfigureServer>(
      ros::NodeHandle(node_, name_space), ros_utils::ReconfigureTable(fields, values), refusals_,
      std::move(apply)));
}

void Reconfiguration::serve_node() {
  std::vector<ConfigField> fields = config_fields<MoveBaseParams>();
  // Who waits for whom is settled at the start.
  const auto is_fixed = [](const ConfigField& one) {
    return one.name == "lockstep" || one.name == "localization_lead" || one.name == "goal_patience";
  };
  fields.erase(std::remove_if(fields.begin(), fields.end(), is_fixed), fields.end());
  add_server("", fields, only_fields(parts_.tree, fields),
             [this](const ConfigNode& values) { change_node(values); });
}

void Reconfiguration::serve_planner() {
  add_server(parts_.planner_space, planner_fields(parts_.params.base_global_planner),
             map_of(parts_.tree.find(parts_.planner_space)),
             [this](const ConfigNode& values) { change_planner(values); });
}

void Reconfiguration::serve_controller() {
  const Lock lock(mutex_);
  add_server(parts_.controller_space, controller_fields(parts_.params.base_local_planner),
             control_.given, [this](const ConfigNode& values) { change_controller(values); });
}

void Reconfiguration::serve_costmap(CostmapNode& costmap, const std::string& name) {
  add_server(name, costmap.live_fields(), map_of(nullptr),
             [this, &costmap, name](const ConfigNode& values) {
               costmap.change(values);
               if (&costmap == parts_.local.get()) change_footprint();
             });
  for (const LayerSpec& spec : costmap.layer_specs()) serve_layer(costmap, name, spec);
}

void Reconfiguration::serve_layer(CostmapNode& costmap, const std::string& name,
                                  const LayerSpec& spec) {
  const Registry<LayerType> types = builtin_layer_types();
  const std::string layer = spec.setup.name;
  add_server(name + "/" + layer, types.get(plugin_class(spec.plugin)).live_fields,
             spec.setup.config,
             [&costmap, layer](const ConfigNode& values) { costmap.change_layer(layer, values); });
}

void Reconfiguration::change_node(const ConfigNode& values) {
  const Lock lock(mutex_);
  MoveBaseParams params = params_;
  config_detail::ConfigReader::read_struct(values, "parameter", parts_.node_name, params);
  require_same_plugin("base_global_planner", params_.base_global_planner,
                      params.base_global_planner);
  require_same_plugin("base_local_planner", params_.base_local_planner, params.base_local_planner);
  ControllerConfig control = control_;
  control.setup.period_s = 1.0 / params.controller_frequency;
  stage(params, control);
  moving_.stage(std::make_unique<MovingObstacleParams>(params.moving_obstacles));
}

void Reconfiguration::change_planner(const ConfigNode& values) {
  Warnings known;  // they were logged at the start
  parts_.planner->stage(make_planner(parts_.params.base_global_planner, &values,
                                     parts_.node_name + "/" + parts_.planner_space, &known));
}

void Reconfiguration::change_controller(const ConfigNode& values) {
  const Lock lock(mutex_);
  Warnings known;
  ControllerConfig control =
      read_controller_config(&values, parts_.node_name + "/" + parts_.controller_space, &known);
  control.setup.footprint = control_.setup.footprint;
  control.setup.period_s = control_.setup.period_s;
  stage(params_, control);
}

void Reconfiguration::change_footprint() {
  const Lock lock(mutex_);
  ControllerConfig control = control_;
  {
    const auto costs = parts_.local->lock();
    control.setup.footprint = parts_.local->costmap().footprint();
  }
  stage(params_, control);
}

/// Makes all that depends on them before anything is replaced, so that a refusal changes nothing.
void Reconfiguration::stage(const MoveBaseParams& params, const ControllerConfig& control) {
  Warnings known;
  auto controller = make_local_planner(params.base_local_planner, control,
                                       parts_.node_name + "/" + parts_.controller_space, &known);
  auto navigator = std::make_unique<NavigatorParts>(
      make_navigator_parts(params, control.setup, parts_.tree, &known));
  params_ = params;
  control_ = control;
  parts_.world->set_limits(control.setup.limits);
  parts_.controller->stage(std::move(controller));
  navigator_.stage(std::move(navigator));
}

void Reconfiguration::apply() {
  if (const auto moving = moving_.take()) parts_.moving->set_params(*moving);
  if (parts_.navigator->is_recovering()) return;
  if (auto parts = navigator_.take()) parts_.navigator->set_parts(std::move(*parts));
}

}  // namespace trident::nav
