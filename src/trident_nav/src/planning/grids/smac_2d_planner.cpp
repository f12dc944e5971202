// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/planning/smac_2d_planner.h"

#include "planning/grids/grid_route.h"
#include "trident_nav/planning/planner_registry.h"

namespace trident::nav {
namespace {

GridRouteOptions smac_2d_options(const Smac2dParams& params) {
  GridRouteOptions options;
  for (int c = 0; c < kInscribedCost; ++c) {
    options.costs.step[c] = static_cast<float>(1.0 + params.cost_travel_multiplier * c / 252.0);
  }
  if (params.allow_unknown) {
    options.costs.step[kUnknownCost] = static_cast<float>(1.0 + params.cost_travel_multiplier);
  }
  options.tolerance_m = params.tolerance;
  options.jumps = true;
  return options;
}

}  // namespace

Smac2dPlanner::Smac2dPlanner(const Smac2dParams& params)
    : route_(std::make_unique<GridRoute>(smac_2d_options(params))),
      approach_orientation_(params.use_final_approach_orientation) {}

Smac2dPlanner::~Smac2dPlanner() = default;

PlanOutcome Smac2dPlanner::plan(const CostGrid& grid, const Footprint& footprint,
                                const Pose2& start, const Pose2& goal,
                                const MotionLimits& /*limits*/, const CancelFlag& cancel) {
  PlanOutcome outcome = to_outcome(route_->find(grid, footprint, start, goal, cancel), grid, goal);
  if (approach_orientation_ && outcome.path.size() > 1) {
    outcome.path.back().yaw = outcome.path[outcome.path.size() - 2].yaw;
  }
  return outcome;
}

TRIDENT_NAV_PLANNER(smac_2d_planner, "nav2_smac_planner/SmacPlanner2D", Smac2dPlanner, Smac2dParams)

}  // namespace trident::nav
