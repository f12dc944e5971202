// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/poses/smac_options.h"

#include <algorithm>

namespace trident::nav {
namespace {

/// Looks at the cancel flag and the clock are never farther apart.
constexpr int kMaxCheckInterval = 256;

PoseSearchOptions search_options(const SmacPoseParams& params, double resolution) {
  PoseSearchOptions search;
  search.curve_window = params.lookup_table_size / 2.0 / resolution;
  search.expansion_ratio = params.analytic_expansion_ratio;
  search.max_expansion_length = params.analytic_expansion_max_length / resolution;
  search.max_expansion_cost = params.analytic_expansion_max_cost;
  search.overrides_max_cost = params.analytic_expansion_max_cost_override;
  search.max_on_approach_iterations = params.max_on_approach_iterations;
  search.check_interval = std::min(params.terminal_checking_interval, kMaxCheckInterval);
  return search;
}

}  // namespace

PoseRouteOptions pose_route_options(const SmacPoseParams& params, MotionModel model,
                                    double resolution, double radius_m, bool is_quadratic,
                                    bool halves) {
  PoseRouteOptions options;
  options.costs.fill(1.0 - params.retrospective_penalty, params.cost_penalty, is_quadratic);
  options.costs.turning = static_cast<float>(params.non_straight_penalty);
  options.costs.change = static_cast<float>(params.change_penalty);
  options.costs.reversing = static_cast<float>(params.reverse_penalty);
  options.search = search_options(params, resolution);
  options.search.model = model;
  options.search.radius = radius_m / resolution;
  options.heuristic.costs.fill(1.0, params.cost_penalty, is_quadratic);
  options.heuristic.crosses_unknown = params.allow_unknown;
  options.heuristic.halves = halves;
  options.heuristic.keeps_changed = params.cache_obstacle_heuristic;
  options.tolerance_m = params.tolerance;
  options.max_iterations = params.max_iterations == 0 ? -1 : params.max_iterations;
  options.max_time_s = params.max_planning_time;
  if (params.smooth_path) {
    ShortcutOptions shortcuts;
    shortcuts.model = model;
    shortcuts.radius = options.search.radius;
    shortcuts.passes = params.smoother.passes();
    shortcuts.max_tries = params.smoother.max_iterations;
    shortcuts.min_gain = params.smoother.tolerance;
    options.shortcuts = shortcuts;
  }
  return options;
}

}  // namespace trident::nav
