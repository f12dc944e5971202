// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/planning/navfn_planner.h"

#include "planning/grids/grid_route.h"
#include "trident_nav/planning/planner_registry.h"

namespace trident::nav {
namespace {

// navfn's COST_NEUTRAL, COST_FACTOR and the highest cost that it enters.
constexpr float kNeutral = 50.0F;
constexpr float kFactor = 0.8F;
constexpr float kHighest = 253.0F;

GridRouteOptions navfn_options(double tolerance_m, bool allow_unknown) {
  GridRouteOptions options;
  options.tolerance_m = tolerance_m;
  options.detours = true;
  for (int c = 0; c < kInscribedCost; ++c) {
    options.costs.step[c] = kNeutral + kFactor * static_cast<float>(c);
  }
  if (allow_unknown) options.costs.step[kUnknownCost] = kHighest;
  return options;
}

}  // namespace

NavfnPlanner::NavfnPlanner(const NavfnParams& params)
    : route_(std::make_unique<GridRoute>(
          navfn_options(params.default_tolerance, params.allow_unknown))) {
  display_.is_wanted = params.visualize_potential;
}

NavfnPlanner::NavfnPlanner(const Nav2NavfnParams& params)
    : route_(std::make_unique<GridRoute>(navfn_options(params.tolerance, params.allow_unknown))),
      approach_orientation_(params.use_final_approach_orientation) {}

NavfnPlanner::~NavfnPlanner() = default;

PlanOutcome NavfnPlanner::plan(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                               const Pose2& goal, const MotionLimits& /*limits*/,
                               const CancelFlag& cancel) {
  geometry_ = grid.geometry;
  PlanOutcome outcome = to_outcome(route_->find(grid, footprint, start, goal, cancel), grid, goal);
  if (approach_orientation_ && outcome.path.size() > 1) {
    outcome.path.back().yaw = outcome.path[outcome.path.size() - 2].yaw;
  }
  return outcome;
}

std::vector<float> NavfnPlanner::potential() const {
  return all_values(route_->potential(), geometry_);
}

void add_navfn_planner(Registry<PlannerFactory>& registry);
void add_navfn_planner(Registry<PlannerFactory>& registry) {
  registry.add("navfn/NavfnROS", planner_factory<NavfnPlanner, NavfnParams>());
  registry.add("nav2_navfn_planner/NavfnPlanner", planner_factory<NavfnPlanner, Nav2NavfnParams>());
}

}  // namespace trident::nav
