// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "planning/grids/jump_points.h"
#include "planning/grids/step_costs.h"
#include "planning/potential/detours.h"
#include "planning/potential/potential.h"
#include "planning/potential/start_search.h"
#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// What a planner on the grid of cells is made of.
struct GridRouteOptions {
  StepCosts costs;
  double tolerance_m = 0.0;  ///< A pose this close to the goal will do [m].
  bool taut = true;          ///< Straight lines where they cost no more than the cells.
  bool outline = false;      ///< Cells along the grid's border are blocked.
  /// Obstacles that have come onto a kept potential's path are led around where they are, as long
  /// as the path, pulled taut, costs no more than the least over cells. Needs `taut`.
  bool detours = false;
  /// Jump points where all free cells cost the same. The potential is not kept then.
  bool jumps = false;
};

/// The points of a route over cells, before it gets headings.
struct GridRouteResult {
  std::vector<Point2> points;
  std::size_t first_free =
      0;  ///< Of the points: the first that lies in a cell that is not blocked.
  /// From the start, or the end of its escape, to the goal; with detours only where it turns.
  std::vector<Cell> cells;
  std::string reason;  ///< A comment on the success, or why there is no route.
  Failure failure = Failure::kNone;
  double cost = 0.0;  ///< Of the cells, or with detours of the taut path over them, in step costs.
};

/// Routes over the 8-neighbor graph of cells: checks the request, leaves a blocked start, tries
/// goals in the tolerance by distance, searches, and pulls the result taut. Keeps the goal's
/// potential for the next plan, unless it jumps.
class GridRoute {
 public:
  explicit GridRoute(const GridRouteOptions& options);

  GridRouteResult find(const CostGrid& grid, const Footprint& footprint, const Pose2& start,
                       const Pose2& goal, const CancelFlag& cancel);
  const Potential& potential() const { return potential_; }

 private:
  void explain_goal(const CostGrid& grid, const Pose2& goal, bool is_occupied,
                    GridRouteResult& result) const;
  std::optional<Cell> reach_goal(const CostGrid& grid, const Pose2& goal, Cell start,
                                 const CancelFlag& cancel, GridRouteResult& result);
  SearchResult search_by_jumps(const CostGrid& grid, Cell goal, Cell start,
                               const CancelFlag& cancel, GridRouteResult& result);
  SearchResult search(const CostGrid& grid, Cell goal, Cell start, const CancelFlag& cancel,
                      GridRouteResult& result);
  /// A path that has been pulled taut.
  struct Taut {
    std::vector<Point2> corners;
    double cost = std::numeric_limits<double>::infinity();
  };
  Taut shortest_detour(const CostGrid& grid, const std::vector<Cell>& path,
                       const CancelFlag& cancel);
  bool lead_around(const CostGrid& grid, const CancelFlag& cancel, GridRouteResult& result);
  void lay_out(const CostGrid& grid, const Pose2& start, const Pose2& goal,
               const std::vector<Cell>& escape, GridRouteResult& result) const;

  GridRouteOptions options_;
  Potential potential_;
  JumpPoints jumps_;
  Detours detours_;
  StartSearch start_search_;
};

/// A route as a planner's outcome: poses at the grid's resolution, headings along the path, the
/// goal's at the end.
PlanOutcome to_outcome(const GridRouteResult& result, const CostGrid& grid, const Pose2& goal);

/// The potential of all cells in rows.
std::vector<float> all_values(const Potential& potential, const GridGeometry& geometry);

}  // namespace trident::nav
