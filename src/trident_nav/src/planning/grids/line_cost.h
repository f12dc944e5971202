// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "planning/grids/step_costs.h"
#include "trident_nav/core/cost_grid.h"

namespace trident::nav {

/// The integral of the step cost along a straight line, lengths in cells; infinite when the line
/// touches a blocked cell, passes exactly between two cells of which one is blocked, or leaves the
/// grid. Also ends with infinity as soon as `limit` is exceeded.
double line_cost(const CostGrid& grid, const StepCosts& costs, Point2 from, Point2 to,
                 double limit = StepCosts::kBlocked);

/// The sum of the line costs between consecutive points.
double path_cost(const CostGrid& grid, const StepCosts& costs, const std::vector<Point2>& points);

/// Replaces runs of points by straight lines wherever that does not raise the integral of the step
/// cost. The first and last points stay. The lines between consecutive points must be free.
std::vector<Point2> pull_taut(const CostGrid& grid, const StepCosts& costs,
                              const std::vector<Point2>& points);

}  // namespace trident::nav
