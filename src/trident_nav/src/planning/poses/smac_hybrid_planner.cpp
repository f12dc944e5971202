// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/planning/smac_hybrid_planner.h"

#include <algorithm>

#include "planning/poses/pose_route.h"
#include "planning/poses/smac_options.h"
#include "trident_nav/planning/planner_registry.h"

namespace trident::nav {
namespace {

std::unique_ptr<PoseRoute> make_route(const SmacHybridParams& params, double resolution,
                                      double radius_m) {
  const MotionModel model = params.motion_model_for_search == SmacMotionModel::kDubin
                                ? MotionModel::kDubins
                                : MotionModel::kReedsShepp;
  const PoseRouteOptions options =
      pose_route_options(params, model, resolution, radius_m, params.use_quadratic_cost_penalty,
                         params.downsample_obstacle_heuristic);
  ArcMotions arcs;
  arcs.model = model;
  arcs.radius = radius_m / resolution;
  arcs.headings = params.angle_quantization_bins;
  arcs.interpolates = params.allow_primitive_interpolation;
  arcs.pose_spacing = CurveChecker::kCheckSpacing / resolution;
  arcs.turning = options.costs.turning;
  arcs.change = options.costs.change;
  arcs.reversing = options.costs.reversing;
  return std::make_unique<PoseRoute>(arc_motions(arcs), options);
}

}  // namespace

SmacHybridPlanner::SmacHybridPlanner(const SmacHybridParams& params) : params_(params) {}

SmacHybridPlanner::~SmacHybridPlanner() = default;

PlanOutcome SmacHybridPlanner::plan(const CostGrid& grid, const Footprint& footprint,
                                    const Pose2& start, const Pose2& goal,
                                    const MotionLimits& limits, const CancelFlag& cancel) {
  const double resolution = grid.geometry.resolution > 0.0 ? grid.geometry.resolution : 1.0;
  const double radius_m =
      std::max({params_.minimum_turning_radius, limits.min_turning_radius, resolution});
  if (route_ == nullptr || resolution != resolution_ || radius_m != radius_m_) {
    route_ = make_route(params_, resolution, radius_m);
    resolution_ = resolution;
    radius_m_ = radius_m;
  }
  return route_->plan(grid, footprint, start, goal, cancel);
}

TRIDENT_NAV_PLANNER(smac_hybrid_planner, "nav2_smac_planner/SmacPlannerHybrid", SmacHybridPlanner,
                    SmacHybridParams)

}  // namespace trident::nav
