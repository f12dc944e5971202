// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/planning/global_planner.h"

#include <algorithm>
#include <cmath>

#include "planning/grids/grid_route.h"
#include "trident_nav/planning/planner_registry.h"

namespace trident::nav {
namespace {

constexpr double kHalfPi = 1.57079632679489661923;

GridRouteOptions global_planner_options(const GlobalPlannerParams& params) {
  GridRouteOptions options;
  options.tolerance_m = params.default_tolerance;
  options.taut = params.use_quadratic && !params.use_grid_path;
  options.detours = options.taut;
  options.outline = params.outline_map;
  const auto highest = static_cast<float>(params.lethal_cost - 1);
  for (int c = 0; c < std::min<int>(params.lethal_cost, kInscribedCost + 1); ++c) {
    const auto cost = static_cast<float>(params.neutral_cost + params.cost_factor * c);
    options.costs.step[c] =
        params.old_navfn_behavior ? cost : std::max(1.0F, std::min(cost, highest));
  }
  if (params.allow_unknown) options.costs.step[kUnknownCost] = std::max(1.0F, highest);
  return options;
}

/// Headings of travel, each over a window.
void orient_along(Path& path, int window, double offset) {
  const int last = static_cast<int>(path.size()) - 1;
  for (int i = 1; i < last; ++i) {
    const Pose2& a = path[static_cast<std::size_t>(std::max(0, i - window))];
    const Pose2& b = path[static_cast<std::size_t>(std::min(last, i + window))];
    path[static_cast<std::size_t>(i)].yaw = wrap_angle(std::atan2(b.y - a.y, b.x - a.x) + offset);
  }
}

void interpolate(Path& path, std::size_t from, std::size_t to) {
  const double first = path[from].yaw;
  const double turn = wrap_angle(path[to].yaw - first);
  for (std::size_t i = from + 1; i < to; ++i) {
    const double t = static_cast<double>(i - from) / static_cast<double>(to - from);
    path[i].yaw = wrap_angle(first + t * turn);
  }
}

/// From the last change of heading on, the headings change evenly to the goal's.
void forward_then_interpolate(Path& path, int window) {
  constexpr double kSameHeading = 0.35;
  orient_along(path, window, 0.0);
  const std::size_t last = path.size() - 1;
  std::size_t from = last - 1;
  const double final_heading = path[from].yaw;
  while (from > 1 && std::abs(wrap_angle(path[from - 1].yaw - final_heading)) < kSameHeading) {
    --from;
  }
  interpolate(path, from, last);
}

}  // namespace

void set_orientations(Path& path, OrientationMode mode, int window) {
  if (path.size() < 3) return;
  switch (mode) {
    case OrientationMode::kNone:
      for (std::size_t i = 1; i + 1 < path.size(); ++i) path[i].yaw = 0.0;
      break;
    case OrientationMode::kForward:
      orient_along(path, window, 0.0);
      break;
    case OrientationMode::kInterpolate:
      interpolate(path, 0, path.size() - 1);
      break;
    case OrientationMode::kForwardThenInterpolate:
      forward_then_interpolate(path, window);
      break;
    case OrientationMode::kBackward:
      orient_along(path, window, 2.0 * kHalfPi);
      break;
    case OrientationMode::kLeftward:
      orient_along(path, window, -kHalfPi);
      break;
    case OrientationMode::kRightward:
      orient_along(path, window, kHalfPi);
      break;
  }
}

GlobalPlanner::GlobalPlanner(const GlobalPlannerParams& params)
    : params_(params), route_(std::make_unique<GridRoute>(global_planner_options(params))) {}

GlobalPlanner::~GlobalPlanner() = default;

PlanOutcome GlobalPlanner::plan(const CostGrid& grid, const Footprint& footprint,
                                const Pose2& start, const Pose2& goal,
                                const MotionLimits& /*limits*/, const CancelFlag& cancel) {
  geometry_ = grid.geometry;
  PlanOutcome outcome = to_outcome(route_->find(grid, footprint, start, goal, cancel), grid, goal);
  if (!outcome.path.empty()) outcome.path.front().yaw = start.yaw;
  set_orientations(outcome.path, static_cast<OrientationMode>(params_.orientation_mode),
                   params_.orientation_window_size);
  return outcome;
}

std::vector<float> GlobalPlanner::potential() const {
  return all_values(route_->potential(), geometry_);
}

TRIDENT_NAV_PLANNER(global_planner, "global_planner/GlobalPlanner", GlobalPlanner,
                    GlobalPlannerParams)

}  // namespace trident::nav
