// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/move_base_parts.h"

#include <utility>
#include <vector>

#include "trident_nav/costmap/costmap_config.h"
#include "trident_ros/node_params.h"

namespace trident::nav {
namespace {

std::unique_ptr<CostmapNode> make_costmap(const ros::NodeHandle& private_node,
                                          const std::string& name, const MoveBaseParts& parts,
                                          const tf2::BufferCore& buffer,
                                          ros_utils::Refusals& refusals, Warnings* warnings) {
  return std::make_unique<CostmapNode>(
      ros::NodeHandle(private_node, name),
      costmap_config_of(parts.tree, parts.node_name, name, warnings), buffer, refusals);
}

void make_controller_of(MoveBaseParts* parts, Warnings* warnings) {
  const std::string name = parts->node_name + "/" + parts->controller_space;
  parts->control =
      read_controller_config(parts->tree.find(parts->controller_space), name, warnings);
  parts->control.setup.footprint = parts->local->costmap().footprint();
  parts->control.setup.period_s = 1.0 / parts->params.controller_frequency;
  parts->controller = std::make_unique<StagedController>(
      make_local_planner(parts->params.base_local_planner, parts->control, name, warnings));
}

void make_planner_of(MoveBaseParts* parts, Warnings* warnings) {
  const std::string& space = parts->planner_space;
  parts->planner = std::make_unique<StagedPlanner>(
      make_planner(parts->params.base_global_planner, parts->tree.find(space),
                   parts->node_name + "/" + space, warnings));
}

/// The local costmap's scans are those that are tracked, at the heights at which they mark.
void make_moving_obstacles(MoveBaseParts* parts) {
  parts->moving = std::make_unique<MovingObstacles>(parts->params.moving_obstacles);
  MovingObstacles* const moving = parts->moving.get();
  parts->local->set_scan_listener(
      [moving](const BeamSource& source, const LaserScan& scan, Span<const SE3> poses) {
        if (!moving->is_enabled()) return;
        const HeightBand heights{source.params().min_obstacle_height,
                                 source.params().max_obstacle_height};
        moving->add_scan(source.name(), 1e-9 * static_cast<double>(scan.stamp_ns),
                         scan_points(scan, poses, heights));
      });
}

}  // namespace

ConfigNode parameters_below(const ros::NodeHandle& private_node) {
  XmlRpc::XmlRpcValue value;
  private_node.getParam(private_node.getNamespace(), value);
  ConfigNode tree = ros_utils::to_config_node(value);
  tree.kind = ConfigNode::Kind::kMap;
  return tree;
}

CostmapConfig costmap_config_of(const ConfigNode& tree, const std::string& node_name,
                                const std::string& name, Warnings* warnings) {
  ConfigNode none;
  none.kind = ConfigNode::Kind::kMap;
  const ConfigNode* const own = tree.find(name);
  CostmapConfigSource source;
  source.path = node_name + "/" + name;
  source.above = &tree;
  CostmapConfig config =
      read_costmap_config(own != nullptr ? *own : none, source, builtin_layer_types());
  warnings->insert(warnings->end(), config.warnings.begin(), config.warnings.end());
  return config;
}

NavigatorParts make_navigator_parts(const MoveBaseParams& params, const ControlSetup& setup,
                                    const ConfigNode& tree, Warnings* warnings) {
  NavigatorParts parts{params, setup.limits, setup.footprint, {}};
  parts.recoveries =
      make_recoveries(params, {setup.limits, setup.footprint, setup.period_s}, tree, warnings);
  return parts;
}

std::unique_ptr<MoveBaseParts> make_move_base_parts(const ros::NodeHandle& private_node,
                                                    const tf2::BufferCore& buffer,
                                                    ros_utils::Refusals& refusals) {
  ros_utils::NodeParams node_params(private_node);
  auto parts = std::make_unique<MoveBaseParts>();
  Warnings warnings;
  parts->node_name = private_node.getNamespace();
  parts->tree = parameters_below(private_node);
  parts->params = node_params.read<MoveBaseParams>();
  parts->planner_space = plugin_namespace(parts->params.base_global_planner);
  parts->controller_space = plugin_namespace(parts->params.base_local_planner);
  parts->global = make_costmap(private_node, "global_costmap", *parts, buffer, refusals, &warnings);
  parts->local = make_costmap(private_node, "local_costmap", *parts, buffer, refusals, &warnings);
  make_moving_obstacles(parts.get());
  make_planner_of(parts.get(), &warnings);
  make_controller_of(parts.get(), &warnings);
  const ControlSetup& setup = parts->control.setup;
  parts->world = std::make_unique<PlanningThread>(*parts->global, *parts->local, *parts->planner,
                                                  setup.limits);
  parts->world->set_odometry_topic(parts->control.odom_topic);
  if (parts->params.lockstep) {
    parts->world->plan_at_once();
    parts->local->set_lockstep();
    parts->global->set_lockstep();
  }
  NavigatorParts navigator = make_navigator_parts(parts->params, setup, parts->tree, &warnings);
  std::vector<std::string> spaces = {"global_costmap", "local_costmap", parts->planner_space,
                                     parts->controller_space};
  for (const NamedRecovery& recovery : navigator.recoveries) spaces.push_back(recovery.name);
  parts->navigator =
      std::make_unique<Navigator>(std::move(navigator), *parts->world, *parts->controller);

  node_params.accept(spaces);
  for (std::string& warning : warnings) node_params.add_warning(std::move(warning));
  node_params.log_warnings();
  return parts;
}

}  // namespace trident::nav
