// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/grids/grid_route.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "planning/grids/line_cost.h"
#include "planning/grids/path_points.h"
#include "planning/plan_request.h"

namespace trident::nav {
namespace {

std::string meters_text(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f m", value);
  return text;
}

std::string occupied_text(const char* name, const Pose2& pose, std::uint8_t cost, double within_m) {
  const char* what = cost == kLethalCost      ? "an obstacle"
                     : cost == kUnknownCost   ? "unknown space"
                     : cost == kInscribedCost ? "the inscribed radius of an obstacle"
                                              : "blocked space";
  return std::string("The ") + name + " " + place_text(pose.x, pose.y) + " lies in " + what +
         ", and no free place is within " + meters_text(within_m) + " of it.";
}

void fail(GridRouteResult& result, Failure failure, std::string reason) {
  result.failure = failure;
  result.reason = std::move(reason);
}

void comment(GridRouteResult& result, const std::string& text) {
  result.reason += result.reason.empty() ? text : " " + text;
}

std::vector<Point2> centers(const GridGeometry& geometry, const std::vector<Cell>& cells) {
  std::vector<Point2> points;
  points.reserve(cells.size());
  for (const Cell c : cells) points.push_back(geometry.center(c));
  return points;
}

/// Ends a route's points at the goal, if its cells lead there.
void add_end(const GridGeometry& geometry, const Pose2& goal, std::vector<Point2>& points,
             GridRouteResult& result) {
  if (result.cells.back() == geometry.cell(goal.x, goal.y)) {
    points.push_back({goal.x, goal.y});
    return;
  }
  const Point2& end = points.back();
  comment(result, "The goal cannot be reached; the path ends at " + place_text(end.x, end.y) +
                      ", " + meters_text(distance(end.x, end.y, goal.x, goal.y)) + " from it.");
}

}  // namespace

GridRoute::GridRoute(const GridRouteOptions& options)
    : options_(options),
      potential_(options.costs, options.outline),
      jumps_(options.costs, options.outline),
      detours_(options.costs, options.outline),
      start_search_(options.outline) {}

GridRouteResult GridRoute::find(const CostGrid& grid, const Footprint& footprint,
                                const Pose2& start, const Pose2& goal, const CancelFlag& cancel) {
  GridRouteResult result;
  if (const auto refusal = refused(grid, start, goal)) {
    fail(result, refusal->failure, refusal->reason);
    return result;
  }
  const Cell start_cell = grid.geometry.cell(start.x, start.y);
  const double reach = escape_reach(footprint);
  const std::vector<Cell> escape = escape_cells(grid, options_.costs, start_cell, reach);
  if (escape.empty()) {
    fail(result, Failure::kStartOccupied,
         occupied_text("start", start, grid.at(start_cell), reach));
    return result;
  }
  const auto reached = reach_goal(grid, goal, escape.back(), cancel, result);
  if (!reached) return result;
  lay_out(grid, start, goal, escape, result);
  if (escape.size() > 1) {
    const Point2 exit = grid.geometry.center(escape.back());
    comment(result, "The start lies in blocked space; the path leaves it at " +
                        place_text(exit.x, exit.y) + ".");
  }
  return result;
}

void GridRoute::explain_goal(const CostGrid& grid, const Pose2& goal, bool is_occupied,
                             GridRouteResult& result) const {
  if (is_occupied) {
    const std::uint8_t cost = grid.at(grid.geometry.cell(goal.x, goal.y));
    fail(result, Failure::kGoalOccupied, occupied_text("goal", goal, cost, options_.tolerance_m));
  } else {
    fail(result, Failure::kNoPath,
         "No path leads to the goal " + place_text(goal.x, goal.y) +
             ": obstacles cut it off from the start.");
  }
}

// The goal's cell, or the nearest in the tolerance from which the start can be reached.
std::optional<Cell> GridRoute::reach_goal(const CostGrid& grid, const Pose2& goal, Cell start,
                                          const CancelFlag& cancel, GridRouteResult& result) {
  std::vector<Cell> cells = cells_near(grid, options_.costs, goal, options_.tolerance_m);
  const Cell own = grid.geometry.cell(goal.x, goal.y);
  const bool occupied = cells.empty() || !(cells.front() == own);
  while (!cells.empty()) {
    const Cell root = cells.front();
    const auto outcome = search(grid, root, start, cancel, result);
    if (outcome == SearchResult::kCanceled) {
      fail(result, Failure::kCanceled, "Planning was canceled.");
      return std::nullopt;
    }
    if (outcome == SearchResult::kFound) return root;
    // What this search came to is cut off from the start as well.
    cells.erase(std::remove_if(cells.begin(), cells.end(),
                               [&](Cell c) { return c == root || potential_.reached(c); }),
                cells.end());
  }
  explain_goal(grid, goal, occupied, result);
  return std::nullopt;
}

// No path where jumps are not wanted, or steps do not all cost the same.
SearchResult GridRoute::search_by_jumps(const CostGrid& grid, Cell goal, Cell start,
                                        const CancelFlag& cancel, GridRouteResult& result) {
  if (!options_.jumps || !jumps_.read(grid)) return SearchResult::kNoPath;
  const SearchResult outcome = jumps_.search(start, goal, cancel);
  if (outcome == SearchResult::kFound) {
    result.cells = jumps_.path();
    result.cost = jumps_.cost();
  }
  return outcome;
}

// The cells from the start to the goal and their cost. Without a path the search always starts at
// the goal, and finds which other goals are cut off as well.
SearchResult GridRoute::search(const CostGrid& grid, Cell goal, Cell start,
                               const CancelFlag& cancel, GridRouteResult& result) {
  SearchResult outcome = search_by_jumps(grid, goal, start, cancel, result);
  if (outcome != SearchResult::kNoPath) return outcome;
  if (options_.detours) {
    outcome = potential_.search(grid, goal, start, cancel, Potential::Costs::kKnown);
    if (outcome != SearchResult::kFound) return outcome;
    if (lead_around(grid, cancel, result)) return outcome;
  }
  outcome = potential_.search(grid, goal, start, cancel);
  if (outcome == SearchResult::kFound) {
    result.cells = potential_.trace();
    result.cost = potential_.at(start);
  }
  return outcome;
}

// A path around what the potential does not know of, without a search from the goal: its path with
// detours, if that costs no more than any over cells can, else the one of least cost over cells.
// False when the potential's path is right as it is, or when too much has changed.
bool GridRoute::lead_around(const CostGrid& grid, const CancelFlag& cancel,
                            GridRouteResult& result) {
  const std::vector<Cell> path = potential_.trace();
  const auto is_dearer = [&](Cell a, Cell b) { return potential_.is_dearer(grid, a, b); };
  if (std::adjacent_find(path.begin(), path.end(), is_dearer) == path.end()) return false;
  const Taut detour = shortest_detour(grid, path, cancel);
  StartSearch::Limits limits;
  limits.expansions = potential_.total_expanded() / 4 + 4096;
  const double bound = std::ceil(detour.cost * potential_.scale());
  if (bound < limits.bound) limits.bound = static_cast<std::uint32_t>(bound);
  const auto outcome = start_search_.search(grid, potential_, limits, cancel);
  if (outcome == StartSearch::Result::kFound) {
    result.cells = start_search_.path();
    result.cost = start_search_.cost() / potential_.scale();
    return true;
  }
  if (outcome != StartSearch::Result::kBound) return false;
  for (const Point2& p : detour.corners) result.cells.push_back(grid.geometry.cell(p.x, p.y));
  result.cost = detour.cost;
  return true;
}

// The path with detours that begin further and further away, until it costs no more than the
// potential of the known costs; the best of them otherwise.
GridRoute::Taut GridRoute::shortest_detour(const CostGrid& grid, const std::vector<Cell>& path,
                                           const CancelFlag& cancel) {
  constexpr std::size_t kReaches[] = {30, 100, 300};
  Taut best;
  for (const std::size_t reach : kReaches) {
    const auto cells = detours_.around(grid, potential_, path, reach, cancel);
    if (!cells) continue;
    Taut taut;
    taut.corners = pull_taut(grid, options_.costs, centers(grid.geometry, *cells));
    taut.cost = path_cost(grid, options_.costs, taut.corners);
    if (taut.cost < best.cost) best = std::move(taut);
    if (best.cost <= static_cast<double>(potential_.at(path.front()))) break;
  }
  return best;
}

void GridRoute::lay_out(const CostGrid& grid, const Pose2& start, const Pose2& goal,
                        const std::vector<Cell>& escape, GridRouteResult& result) const {
  const GridGeometry& g = grid.geometry;
  const bool escapes = escape.size() > 1;
  std::vector<Point2> points;
  if (!escapes) points.push_back({start.x, start.y});
  for (const Cell c : result.cells) points.push_back(g.center(c));
  add_end(g, goal, points, result);
  if (options_.taut) points = pull_taut(grid, options_.costs, points);
  if (escapes) {
    result.points.push_back({start.x, start.y});
    for (std::size_t i = 1; i + 1 < escape.size(); ++i)
      result.points.push_back(g.center(escape[i]));
  }
  result.first_free = result.points.size();
  result.points.insert(result.points.end(), points.begin(), points.end());
}

PlanOutcome to_outcome(const GridRouteResult& result, const CostGrid& grid, const Pose2& goal) {
  PlanOutcome outcome;
  outcome.failure = result.failure;
  outcome.reason = result.reason;
  outcome.cost = result.cost;
  if (result.failure != Failure::kNone) return outcome;
  outcome.path = poses_along(result.points, grid.geometry.resolution, goal.yaw);
  return outcome;
}

std::vector<float> all_values(const Potential& potential, const GridGeometry& geometry) {
  std::vector<float> values;
  values.reserve(geometry.size());
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) values.push_back(potential.at({x, y}));
  }
  return values;
}

}  // namespace trident::nav
