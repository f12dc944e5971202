// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/planning/theta_star_planner.h"

#include <string>

#include "planning/grids/grid_route.h"
#include "planning/grids/line_cost.h"
#include "planning/grids/theta_search.h"
#include "trident_base/error.h"
#include "trident_nav/planning/planner_registry.h"

namespace trident::nav {
namespace {

GridRouteOptions theta_options(const ThetaStarParams& params) {
  GridRouteOptions options;
  for (int c = 0; c < kInscribedCost; ++c) {
    const double share = c / 252.0;
    options.costs.step[c] =
        static_cast<float>(params.w_euc_cost + params.w_traversal_cost * share * share);
  }
  if (params.allow_unknown) {
    options.costs.step[kUnknownCost] =
        static_cast<float>(params.w_euc_cost + params.w_traversal_cost);
  }
  return options;
}

/// Puts the corners between the ends of a route whose cells they replace.
void replace_points(GridRouteResult& result, const GridGeometry& geometry,
                    const std::vector<Cell>& corners, std::size_t kept) {
  const Point2 end = result.points.back();
  result.points.resize(kept);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    result.points.push_back(geometry.center(corners[i]));
  }
  result.points.push_back(end);
}

double cost_of(const CostGrid& grid, const StepCosts& costs, const std::vector<Point2>& points,
               std::size_t from) {
  double sum = 0.0;
  for (std::size_t i = from + 1; i < points.size(); ++i) {
    sum += line_cost(grid, costs, points[i - 1], points[i]);
  }
  return sum;
}

void face_as_driven(Path& path) {
  if (path.size() > 1) path.back().yaw = path[path.size() - 2].yaw;
}

}  // namespace

void ThetaStarParams::validate() const {
  if (how_many_corners == 4 || how_many_corners == 8) return;
  throw Error("how_many_corners: " + std::to_string(how_many_corners) + ", legal: 4 or 8");
}

ThetaStarPlanner::ThetaStarPlanner(const ThetaStarParams& params)
    : params_(params),
      route_(std::make_unique<GridRoute>(theta_options(params))),
      search_(std::make_unique<ThetaSearch>(theta_options(params).costs, params.how_many_corners)) {
}

ThetaStarPlanner::~ThetaStarPlanner() = default;

PlanOutcome ThetaStarPlanner::plan(const CostGrid& grid, const Footprint& footprint,
                                   const Pose2& start, const Pose2& goal,
                                   const MotionLimits& /*limits*/, const CancelFlag& cancel) {
  GridRouteResult route = route_->find(grid, footprint, start, goal, cancel);
  if (route.failure != Failure::kNone) return to_outcome(route, grid, goal);
  const StepCosts costs = theta_options(params_).costs;
  const std::size_t first = route.first_free;
  route.cost = cost_of(grid, costs, route.points, first);
  const auto found =
      search_->search(grid, route.cells.front(), route.cells.back(), route.cost, cancel);
  if (found == ThetaSearch::Result::kCanceled) {
    route.failure = Failure::kCanceled;
    route.reason = "Planning was canceled.";
  } else if (found == ThetaSearch::Result::kFound) {
    GridRouteResult other = route;
    replace_points(other, grid.geometry, search_->corners(), first + 1);
    other.cost = cost_of(grid, costs, other.points, first);
    if (other.cost < route.cost) route = other;
  }
  PlanOutcome outcome = to_outcome(route, grid, goal);
  if (params_.use_final_approach_orientation) face_as_driven(outcome.path);
  return outcome;
}

TRIDENT_NAV_PLANNER(theta_star_planner, "nav2_theta_star_planner/ThetaStarPlanner",
                    ThetaStarPlanner, ThetaStarParams)

}  // namespace trident::nav
