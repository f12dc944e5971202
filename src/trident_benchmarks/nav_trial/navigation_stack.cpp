// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "navigation_stack.h"

#include <algorithm>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/costmap/beam_layer.h"
#include "trident_nav/costmap/costmap_config.h"
#include "trident_nav/costmap/static_layer.h"

namespace trident::benchmarks {
namespace {

// Times of steps are rounded to nanoseconds.
constexpr double kTimeSlack_s = 1e-6;

ConfigNode empty_map() {
  ConfigNode node;
  node.kind = ConfigNode::Kind::kMap;
  return node;
}

void merge(const ConfigNode& over, ConfigNode* under) {
  for (std::size_t i = 0; i < over.keys.size(); ++i) {
    const auto at = std::find(under->keys.begin(), under->keys.end(), over.keys[i]);
    if (at == under->keys.end()) {
      under->keys.push_back(over.keys[i]);
      under->key_lines.push_back(over.key_lines[i]);
      under->items.push_back(over.items[i]);
      continue;
    }
    ConfigNode& old = under->items[static_cast<std::size_t>(at - under->keys.begin())];
    const bool are_maps =
        old.kind == ConfigNode::Kind::kMap && over.items[i].kind == ConfigNode::Kind::kMap;
    if (are_maps) {
      merge(over.items[i], &old);
    } else {
      old = over.items[i];
    }
  }
}

/// The keys that the node itself reads; the others are namespaces of its parts.
ConfigNode own_keys(const ConfigNode& parameters) {
  ConfigNode own = empty_map();
  for (std::size_t i = 0; i < parameters.keys.size(); ++i) {
    const bool is_own_map = parameters.keys[i] == "moving_obstacles";
    if (parameters.items[i].kind == ConfigNode::Kind::kMap && !is_own_map) continue;
    own.keys.push_back(parameters.keys[i]);
    own.key_lines.push_back(parameters.key_lines[i]);
    own.items.push_back(parameters.items[i]);
  }
  return own;
}

std::vector<nav::BeamSource*> beam_sources(nav::Costmap& costmap) {
  std::vector<nav::BeamSource*> sources;
  for (const auto& layer : costmap.layers()) {
    auto* beams = dynamic_cast<nav::BeamLayer*>(layer.get());
    if (beams == nullptr) continue;
    for (nav::BeamSource& source : beams->sources()) sources.push_back(&source);
  }
  return sources;
}

}  // namespace

ConfigNode merged_parameters(const std::vector<std::string>& files) {
  ConfigNode all = empty_map();
  for (const std::string& file : files) {
    const ConfigNode one = parse_yaml(read_config_file(file), file);
    if (one.kind != ConfigNode::Kind::kMap) {
      throw ConfigError(file, one.line, "", one.describe() + ", legal: a map");
    }
    merge(one, &all);
  }
  return all;
}

NavigationStack::TimedCostmap NavigationStack::make_costmap(const ConfigNode& parameters,
                                                            const std::string& name) {
  const ConfigNode none = empty_map();
  const ConfigNode* const own = parameters.find(name);
  Registry<nav::LayerType> layers("costmap layer");
  nav::register_builtin_layers(layers);
  nav::CostmapConfigSource source;
  source.path = name;
  source.above = &parameters;
  const nav::CostmapConfig config =
      nav::read_costmap_config(own != nullptr ? *own : none, source, layers);
  warnings_.insert(warnings_.end(), config.warnings.begin(), config.warnings.end());
  return {std::make_unique<nav::Costmap>(config.params, nav::make_layers(config, layers)), -1.0};
}

NavigationStack::NavigationStack(const ConfigNode& parameters)
    : params_(load_config_node<nav::MoveBaseParams>(own_keys(parameters), "parameter")),
      moving_(params_.moving_obstacles),
      global_(make_costmap(parameters, "global_costmap")),
      local_(make_costmap(parameters, "local_costmap")) {
  const std::string planner = nav::plugin_namespace(params_.base_global_planner);
  planner_ =
      nav::make_planner(params_.base_global_planner, parameters.find(planner), planner, &warnings_);
  const std::string space = nav::plugin_namespace(params_.base_local_planner);
  nav::ControllerConfig control =
      nav::read_controller_config(parameters.find(space), space, &warnings_);
  control.setup.footprint = local_.costmap->footprint();
  control.setup.period_s = control_period_s();
  controller_ = nav::make_local_planner(params_.base_local_planner, control, space, &warnings_);
  const nav::ControlSetup& setup = control.setup;
  world_ = std::make_unique<nav::CostmapWorld>(*global_.costmap, *local_.costmap, *planner_,
                                               setup.limits);
  nav::NavigatorParts parts{params_, setup.limits, setup.footprint, {}};
  parts.recoveries = nav::make_recoveries(params_, {setup.limits, setup.footprint, setup.period_s},
                                          parameters, &warnings_);
  navigator_ = std::make_unique<nav::Navigator>(std::move(parts), *world_, *controller_);
}

void NavigationStack::TimedCostmap::update(double now_s, const nav::Pose2& robot) {
  const double rate = costmap->params().update_frequency;
  if (updated_s >= 0.0 && (now_s - updated_s) * rate < 1.0 - kTimeSlack_s * rate) return;
  costmap->update({now_s, robot});
  updated_s = now_s;
}

bool NavigationStack::is_control_due(double now_s) const {
  return controlled_s_ < 0.0 || now_s - controlled_s_ >= control_period_s() - kTimeSlack_s;
}

void NavigationStack::set_map(const OccupancyGrid& map) {
  for (const TimedCostmap* timed : {&global_, &local_}) {
    for (const auto& layer : timed->costmap->layers()) {
      if (auto* fixed = dynamic_cast<nav::StaticLayer*>(layer.get())) fixed->set_map(map);
    }
  }
}

void NavigationStack::add_scan(const PlacedScan& placed) {
  const std::vector<SE3> in_odom = placed.laser_poses();
  std::vector<SE3> in_map;
  for (const SE3& pose : in_odom) in_map.push_back(T_map_odom_.to_se3() * pose);
  for (nav::BeamSource* source : beam_sources(*global_.costmap)) {
    source->add(nav::observe_scan(placed.scan, in_map, source->params().inf_is_valid));
  }
  for (nav::BeamSource* source : beam_sources(*local_.costmap)) {
    source->add(nav::observe_scan(placed.scan, in_odom, source->params().inf_is_valid));
    track(*source, placed.scan, in_odom);
  }
}

/// At the heights at which the source marks.
void NavigationStack::track(const nav::BeamSource& source, const LaserScan& scan,
                            const std::vector<SE3>& poses) {
  if (!moving_.is_enabled()) return;
  const nav::HeightBand heights{source.params().min_obstacle_height,
                                source.params().max_obstacle_height};
  moving_.add_scan(source.name(), 1e-9 * static_cast<double>(scan.stamp_ns),
                   nav::scan_points(scan, poses, heights));
}

nav::NavigatorOutput NavigationStack::cycle(double now_s, const nav::RobotState& robot) {
  controlled_s_ = now_s;
  const SE2 T_map_base = T_map_odom_ * SE2::from_xy_yaw(robot.pose.x, robot.pose.y, robot.pose.yaw);
  const nav::Pose2 in_map{T_map_base.p.x(), T_map_base.p.y(), T_map_base.angle};
  global_.update(now_s, in_map);
  local_.update(now_s, robot.pose);
  world_->set_robot(in_map, robot.pose);
  nav::NavigatorInput input;
  input.now_s = now_s;
  input.robot_global = in_map;
  input.state = robot;
  input.local = local_.costmap->grid();
  input.tracks = tracks_ = moving_.at(now_s);
  return navigator_->step(input);
}

}  // namespace trident::benchmarks
