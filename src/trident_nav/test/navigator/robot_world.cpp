// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "navigator/robot_world.h"

#include <cmath>

#include "trident_base/angle.h"
#include "trident_nav/control/motion.h"
#include "trident_nav/core/footprint.h"
#include "trident_nav/costmap/beam_layer.h"
#include "trident_nav/costmap/layer_factory.h"
#include "trident_nav/costmap/observation.h"
#include "trident_nav/costmap/static_layer.h"
#include "trident_nav/planning/planner_registry.h"

namespace trident::nav::testing {
namespace {

constexpr double kRadius_m = 0.12;
constexpr double kResolution_m = 0.05;
constexpr double kRange_m = 3.5;
constexpr int kBeams = 180;

std::unique_ptr<Layer> layer(const std::string& plugin, const std::string& name,
                             const std::string& yaml) {
  Registry<LayerType> registry("layer");
  register_builtin_layers(registry);
  LayerSetup setup;
  setup.name = name;
  setup.config = parse_yaml(yaml, "test");
  return make_layer(registry, plugin, setup);
}

std::vector<std::unique_ptr<Layer>> layers(const OccupancyGrid* map, const std::string& keys) {
  std::vector<std::unique_ptr<Layer>> result;
  if (map != nullptr) {
    result.push_back(layer("StaticLayer", "static_layer", "{}"));
    dynamic_cast<StaticLayer&>(*result.back()).set_map(*map);
  }
  result.push_back(layer("ObstacleLayer", "obstacle_layer",
                         "{sources: {scan: {data_type: LaserScan, clearing: true, "
                         "inf_is_valid: true" +
                             keys + "}}}"));
  result.push_back(layer("InflationLayer", "inflation_layer",
                         "{inflation_radius: 0.4, cost_scaling_factor: 6.0}"));
  return result;
}

CostmapParams costmap_params(bool is_local) {
  CostmapParams params;
  params.robot_radius = kRadius_m;
  params.footprint_padding = 0.0;
  params.rolling_window = is_local;
  params.width = params.height = 4.0;
  if (is_local) params.global_frame = "odom";
  return params;
}

}  // namespace

std::vector<NamedRecovery> default_recoveries(const RecoverySetup& setup) {
  const RecoveryRegistry registry = builtin_recoveries();
  const auto make = [&](const char* name, const char* plugin, const char* keys) {
    return NamedRecovery{name, registry.get(plugin)(setup, parse_yaml(keys, "test"), "test")};
  };
  std::vector<NamedRecovery> result;
  result.push_back(make("conservative_reset", "clear_costmap_recovery/ClearCostmapRecovery", "{}"));
  result.push_back(make("rotate_recovery", "rotate_recovery/RotateRecovery", "{}"));
  result.push_back(make("aggressive_reset", "clear_costmap_recovery/ClearCostmapRecovery",
                        "{reset_distance: 0.5}"));
  result.push_back(make("retreat", "trident_nav/Retreat", "{}"));
  return result;
}

void RobotWorld::set(OccupancyGrid& grid, const Wall& wall, std::int8_t occupancy) {
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const double cx = (x + 0.5) * grid.resolution, cy = (y + 0.5) * grid.resolution;
      if (cx > wall.x0 && cx < wall.x1 && cy > wall.y0 && cy < wall.y1) {
        grid.cells[grid.index(x, y)] = occupancy;
      }
    }
  }
}

RobotWorld::RobotWorld(const Setup& setup)
    : limits_{0.5, -0.2, 0.0, 1.5, 1.0, 1.5, 0.0, 3.0, 0.0},
      period_s_(1.0 / setup.params.controller_frequency) {
  truth_.width = static_cast<int>(std::lround(setup.width_m / kResolution_m));
  truth_.height = static_cast<int>(std::lround(setup.height_m / kResolution_m));
  truth_.resolution = kResolution_m;
  truth_.cells.assign(truth_.index(0, truth_.height), 0);
  const double w = setup.width_m, h = setup.height_m, t = kResolution_m;
  const std::vector<Wall> border = {{0, 0, w, t}, {0, h - t, w, h}, {0, 0, t, h}, {w - t, 0, w, h}};
  for (const Wall& wall : border) set(truth_, wall, 100);
  for (const Wall& wall : setup.mapped) set(truth_, wall, 100);
  OccupancyGrid map = truth_;
  for (const Wall& wall : setup.unmapped) set(truth_, wall, 100);
  for (const Wall& wall : setup.gone) set(map, wall, 100);

  const Footprint footprint = circle_footprint(kRadius_m);
  global_ = std::make_unique<Costmap>(costmap_params(false), layers(&map, setup.source_keys));
  local_ = std::make_unique<Costmap>(costmap_params(true), layers(nullptr, setup.source_keys));
  planner_ = builtin_planners().get("navfn/NavfnROS")(parse_yaml("{}", "test"), "test");
  ControlSetup control;
  control.limits = limits_;
  control.footprint = footprint;
  control.period_s = period_s_;
  control.tolerance.xy_goal_tolerance = 0.1;
  control.tolerance.yaw_goal_tolerance = 0.1;
  controller_ = make_controller(setup.law, control);
  world_ = std::make_unique<CostmapWorld>(*global_, *local_, *planner_, limits_);
  NavigatorParts parts{setup.params, limits_, footprint,
                       default_recoveries({limits_, footprint, period_s_})};
  navigator_ = std::make_unique<Navigator>(std::move(parts), *world_, *controller_);
  state_.pose = setup.start;
}

double RobotWorld::range(double angle) const {
  constexpr double kStep_m = 0.01;
  const double c = std::cos(state_.pose.yaw + angle), s = std::sin(state_.pose.yaw + angle);
  for (double r = 0.0; r < kRange_m; r += kStep_m) {
    const int x = static_cast<int>((state_.pose.x + r * c) / truth_.resolution);
    const int y = static_cast<int>((state_.pose.y + r * s) / truth_.resolution);
    if (truth_.cells[truth_.index(x, y)] == 100) return r;
  }
  return INFINITY;
}

void RobotWorld::scan() {
  LaserScan scan;
  scan.angle_min = -kPi;
  scan.angle_increment = 2.0 * kPi / kBeams;
  scan.range_max = kRange_m;
  for (int i = 0; i < kBeams; ++i) scan.ranges.push_back(static_cast<float>(range(scan.angle(i))));
  SE3 pose;
  pose.p = {state_.pose.x, state_.pose.y, 0.1};
  pose.R = Eigen::Quaterniond(Eigen::AngleAxisd(state_.pose.yaw, Eigen::Vector3d::UnitZ()));
  for (Costmap* costmap : {global_.get(), local_.get()}) {
    Observation observation = observe_scan(scan, {&pose, 1}, true);
    observation.stamp_s = now_s();
    dynamic_cast<BeamLayer&>(*costmap->layer("obstacle_layer"))
        .find_source("scan")
        ->add(std::move(observation));
  }
}

void RobotWorld::move(const Twist2& command) {
  constexpr int kSubsteps = 10;
  const FootprintChecker body(circle_footprint(kRadius_m));
  const double dt = period_s_ / kSubsteps;
  for (int i = 0; i < kSubsteps; ++i) {
    state_.twist = reachable_window(limits_, state_.twist, dt).clamp(command);
    state_.pose = integrate(state_.pose, state_.twist, dt);
  }
  const double c[] = {0.0, 1.0, 0.0, -1.0}, s[] = {1.0, 0.0, -1.0, 0.0};
  for (int i = 0; i < 4; ++i) {
    const int x = static_cast<int>((state_.pose.x + kRadius_m * c[i]) / truth_.resolution);
    const int y = static_cast<int>((state_.pose.y + kRadius_m * s[i]) / truth_.resolution);
    has_touched_ |= truth_.cells[truth_.index(x, y)] == 100;
  }
}

NavigatorOutput RobotWorld::step() {
  if (is_lidar_on_ && steps_ % 2 == 0) scan();
  const CostmapInput input{now_s(), state_.pose};
  local_->update(input);
  if (steps_ % 4 == 0) global_->update(input);
  world_->set_robot(state_.pose, state_.pose);
  const NavigatorOutput output =
      navigator_->step({now_s(), state_.pose, state_, local_->grid(), {}});
  if (output.recovery) recoveries_.push_back(output.recovery->name);
  if (!output.waiting.empty()) waiting_ = output.waiting;
  move(output.status == NavigatorStatus::kIdle ? Twist2{} : output.twist);
  ++steps_;
  state_.time_s = steps_ * period_s_;
  return output;
}

NavigatorOutput RobotWorld::drive(double limit_s) {
  NavigatorOutput output;
  const double end_s = now_s() + limit_s;
  while (now_s() < end_s) {
    output = step();
    if (output.status != NavigatorStatus::kActive) break;
  }
  return output;
}

}  // namespace trident::nav::testing
