// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/planning/smac_lattice_planner.h"

#include <algorithm>
#include <cmath>

#include "planning/curves/lattice_set.h"
#include "planning/plan_request.h"
#include "planning/poses/pose_route.h"
#include "planning/poses/smac_options.h"
#include "trident_nav/planning/planner_registry.h"

namespace trident::nav {
namespace {

/// Of the set that is made when none is given [m].
constexpr double kDefaultRadius = 0.5;

std::unique_ptr<PoseRoute> make_lattice_route(const SmacLatticeParams& params,
                                              const LatticeSet& set) {
  const MotionModel model =
      params.allow_reverse_expansion ? MotionModel::kReedsShepp : MotionModel::kDubins;
  const double radius_m = std::max(set.turning_radius_m, set.resolution_m);
  const PoseRouteOptions options =
      pose_route_options(params, model, set.resolution_m, radius_m, false, true);
  LatticeCosts costs;
  costs.turning = options.costs.turning;
  costs.change = options.costs.change;
  costs.reversing = options.costs.reversing;
  costs.rotation = static_cast<float>(params.rotation_penalty);
  costs.reverses = params.allow_reverse_expansion;
  return std::make_unique<PoseRoute>(lattice_motions(set, costs, CurveChecker::kCheckSpacing),
                                     options);
}

}  // namespace

SmacLatticePlanner::SmacLatticePlanner(const SmacLatticeParams& params) : params_(params) {
  if (params.lattice_filepath.empty()) return;
  set_ = std::make_unique<LatticeSet>(load_lattice(params.lattice_filepath));
}

SmacLatticePlanner::~SmacLatticePlanner() = default;

// Without a file the set is made for the grid and the robot, unless the last one is for them.
void SmacLatticePlanner::make_set(double resolution, double min_turning_radius) {
  const bool is_made = set_ != nullptr && set_->resolution_m == resolution &&
                       !(set_->turning_radius_m < min_turning_radius);
  if (is_made) return;
  LatticeOptions options;
  options.resolution_m = resolution;
  options.turning_radius_m =
      std::clamp(std::max(kDefaultRadius, min_turning_radius), resolution, 500.0 * resolution);
  set_ = std::make_unique<LatticeSet>(make_lattice(options));
  route_.reset();
}

// Makes what is needed for a grid; a failure when the set does not fit it, or the robot.
PlanOutcome SmacLatticePlanner::prepare(const CostGrid& grid, const MotionLimits& limits) {
  const double resolution = grid.geometry.resolution;
  if (params_.lattice_filepath.empty()) make_set(resolution, limits.min_turning_radius);
  if (std::abs(set_->resolution_m - resolution) > 1e-3 * resolution) {
    return failed(Failure::kInvalidInput,
                  params_.lattice_filepath +
                      ": lattice_metadata.grid_resolution: " + std::to_string(set_->resolution_m) +
                      ", legal: that of the costmap, " + std::to_string(resolution) + " m.");
  }
  if (set_->turning_radius_m < limits.min_turning_radius - 1e-9 && set_->motion_model != "omni") {
    return failed(Failure::kInvalidInput,
                  params_.lattice_filepath + ": lattice_metadata.turning_radius: " +
                      std::to_string(set_->turning_radius_m) + ", legal: at least the robot's " +
                      std::to_string(limits.min_turning_radius) + " m.");
  }
  if (route_ == nullptr) route_ = make_lattice_route(params_, *set_);
  return {};
}

PlanOutcome SmacLatticePlanner::plan(const CostGrid& grid, const Footprint& footprint,
                                     const Pose2& start, const Pose2& goal,
                                     const MotionLimits& limits, const CancelFlag& cancel) {
  if (auto refusal = refused(grid, start, goal)) return *refusal;
  PlanOutcome unfit = prepare(grid, limits);
  if (unfit.failure != Failure::kNone) return unfit;
  return route_->plan(grid, footprint, start, goal, cancel);
}

TRIDENT_NAV_PLANNER(smac_lattice_planner, "nav2_smac_planner/SmacPlannerLattice",
                    SmacLatticePlanner, SmacLatticeParams)

}  // namespace trident::nav
