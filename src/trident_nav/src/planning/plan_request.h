// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planning/grids/step_costs.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// "(1.25, -3.40)".
std::string place_text(double x, double y);

PlanOutcome failed(Failure failure, std::string reason);

/// The failure of a request that no planner can serve: values that are not finite, an empty grid, a
/// grid with sides of more than 65,000 cells, a pose outside.
std::optional<PlanOutcome> refused(const CostGrid& grid, const Pose2& start, const Pose2& goal);

/// Cells from a start in blocked ones to the first that is not, the start included: along the
/// ascent of the distance field where there is one, else straight to the nearest. Empty when none
/// lies within `reach_m`. One cell when the start is not blocked.
std::vector<Cell> escape_cells(const CostGrid& grid, const StepCosts& costs, Cell start,
                               double reach_m);

/// Cells whose center lies within `tolerance_m` of a point and that are not blocked, by distance;
/// the point's own cell comes first if it is not blocked.
std::vector<Cell> cells_near(const CostGrid& grid, const StepCosts& costs, const Pose2& goal,
                             double tolerance_m);

/// How far a start may lie within blocked cells: this many circumscribed radii and one metre.
double escape_reach(const Footprint& footprint);

}  // namespace trident::nav
