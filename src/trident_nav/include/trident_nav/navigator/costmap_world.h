// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "trident_nav/costmap/costmap.h"
#include "trident_nav/navigator/avoided_places.h"
#include "trident_nav/navigator/navigator_world.h"
#include "trident_nav/planning/planner.h"

namespace trident::nav {

/// What a path costs on a grid, see NavigatorWorld::path_cost().
double path_cost_on(const CostGrid& grid, const Path& path, std::size_t first);

/// Lets a costmap's layers forget what they sensed in an area about the robot.
void forget_area(Costmap& costmap, const Pose2& robot, const ClearedArea& area);

/// The layers that hold a lethal cost in a cell, with the topics of their sources:
/// "obstacle_layer (scan)"; empty when nothing is found.
std::string lethal_layers_text(const Costmap& costmap, Cell cell);

/// The obstacle nearest to a robot within `reach_m`, see NavigatorWorld::obstacle_text().
std::string nearest_obstacle_text(const Costmap& costmap, const Pose2& robot, double reach_m);

/// A world in one thread: plans are made at once. What is referred to outlives it. The owner
/// updates both costmaps, at their rates, between the navigator's steps.
class CostmapWorld : public NavigatorWorld {
 public:
  CostmapWorld(Costmap& global, Costmap& local, Planner& planner, const MotionLimits& limits)
      : global_(global), local_(local), planner_(planner), limits_(limits) {}

  /// Where the robot is in the frames of the two costmaps; set before each step.
  void set_robot(const Pose2& in_global, const Pose2& in_local) {
    robot_global_ = in_global;
    robot_local_ = in_local;
  }

  void request_plan(const Pose2& start, const Pose2& goal) override;
  std::optional<PlanOutcome> take_plan() override;
  void cancel_plan() override { outcome_.reset(); }
  double path_cost(const Path& path, std::size_t first) override;
  void avoid(const Path& ahead) override;
  void forget(const ClearedArea& area) override;
  std::vector<StaleSource> stale_sources(double now_s) override;
  std::string obstacle_text(const Pose2& robot_local) override;

 private:
  Costmap& global_;
  Costmap& local_;
  Planner& planner_;
  MotionLimits limits_;
  AvoidedPlaces avoided_;
  Pose2 robot_global_, robot_local_;
  std::optional<PlanOutcome> outcome_;
};

}  // namespace trident::nav
