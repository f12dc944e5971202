// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/planning/robot_planner.h"

#include "trident_nav/planning/planner_registry.h"

namespace trident::nav {

RobotPlanner::RobotPlanner(const RobotPlannerParams& params)
    : params_(params), navfn_(params.navfn) {}

Planner& RobotPlanner::planner_for(const MotionLimits& limits) {
  if (limits.min_turning_radius <= 0.0) return navfn_;
  const SmacMotionModel model =
      limits.vx_min < 0.0 ? SmacMotionModel::kReedsShepp : SmacMotionModel::kDubin;
  if (hybrid_ == nullptr || model != hybrid_model_) {
    SmacHybridParams params = params_.hybrid;
    params.motion_model_for_search = hybrid_model_ = model;
    params.minimum_turning_radius = limits.min_turning_radius;
    hybrid_ = std::make_unique<SmacHybridPlanner>(params);
  }
  return *hybrid_;
}

PlanOutcome RobotPlanner::plan(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                               const Pose2& goal, const MotionLimits& limits,
                               const CancelFlag& cancel) {
  return planner_for(limits).plan(grid, footprint, start, goal, limits, cancel);
}

TRIDENT_NAV_PLANNER(robot_planner, "trident_nav/RobotPlanner", RobotPlanner, RobotPlannerParams)

}  // namespace trident::nav
