// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/plan_request.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

#include "planning/grids/grid_directions.h"

namespace trident::nav {
namespace {

constexpr int kMaxSide = 65000;

bool finite(const Pose2& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.yaw);
}

std::string extent_text(const GridGeometry& g) {
  return "x " + std::to_string(g.origin_x) + " ... " +
         std::to_string(g.origin_x + g.width * g.resolution) + ", y " + std::to_string(g.origin_y) +
         " ... " + std::to_string(g.origin_y + g.height * g.resolution) + " m";
}

std::optional<PlanOutcome> outside(const GridGeometry& g, const Pose2& pose, const char* name,
                                   Failure failure) {
  const double right = g.origin_x + g.width * g.resolution;
  const double top = g.origin_y + g.height * g.resolution;
  if (pose.x >= g.origin_x && pose.y >= g.origin_y && pose.x < right && pose.y < top &&
      g.contains(g.cell(pose.x, pose.y))) {
    return std::nullopt;
  }
  return failed(failure, std::string("The ") + name + " " + place_text(pose.x, pose.y) +
                             " lies outside of the costmap, which covers " + extent_text(g) + ".");
}

/// The best neighbor by distance to obstacles; the cell itself when none is farther from them.
Cell uphill(const CostGrid& grid, Cell c) {
  Cell best = c;
  float most = grid.distance_m[grid.geometry.index(c)];
  for (int d = 0; d < 8; ++d) {
    const Cell n{c.x + kDx[d], c.y + kDy[d]};
    if (!grid.geometry.contains(n)) continue;
    const float value = grid.distance_m[grid.geometry.index(n)];
    if (value > most) {
      most = value;
      best = n;
    }
  }
  return best;
}

std::vector<Cell> climb(const CostGrid& grid, const StepCosts& costs, Cell start, double reach_m) {
  std::vector<Cell> cells{start};
  const auto limit = static_cast<std::size_t>(reach_m / grid.geometry.resolution) + 1;
  while (costs.blocked(grid.at(cells.back()))) {
    const Cell next = uphill(grid, cells.back());
    if (next == cells.back() || cells.size() > limit) return {};
    cells.push_back(next);
  }
  return cells;
}

/// The free cell nearest to the start, by rings of squares.
std::optional<Cell> nearest_free(const CostGrid& grid, const StepCosts& costs, Cell start,
                                 int reach) {
  std::optional<Cell> best;
  double least = reach + 1e-9;
  for (int ring = 1; ring <= reach && ring <= least; ++ring) {
    for (int dy = -ring; dy <= ring; ++dy) {
      const int stride = std::abs(dy) == ring ? 1 : 2 * ring;
      for (int dx = -ring; dx <= ring; dx += stride) {
        const Cell c{start.x + dx, start.y + dy};
        const double d = std::hypot(dx, dy);
        if (d >= least || !grid.geometry.contains(c) || costs.blocked(grid.at(c))) continue;
        least = d;
        best = c;
      }
    }
  }
  return best;
}

std::vector<Cell> straight(Cell from, Cell to) {
  std::vector<Cell> cells;
  const int steps = std::max(std::abs(to.x - from.x), std::abs(to.y - from.y));
  for (int i = 0; i <= steps; ++i) {
    const double t = steps == 0 ? 0.0 : static_cast<double>(i) / steps;
    cells.push_back({from.x + static_cast<int>(std::lround(t * (to.x - from.x))),
                     from.y + static_cast<int>(std::lround(t * (to.y - from.y)))});
  }
  return cells;
}

bool has_cells(const CostGrid& grid) {
  const GridGeometry& g = grid.geometry;
  return g.width > 0 && g.height > 0 && g.resolution > 0.0 && grid.cost != nullptr;
}

/// A grid that no path can be searched in.
std::optional<PlanOutcome> refused(const CostGrid& grid) {
  const GridGeometry& g = grid.geometry;
  if (!has_cells(grid)) {
    return failed(Failure::kInvalidInput, "The costmap is empty: no map has arrived yet.");
  }
  if (g.width > kMaxSide || g.height > kMaxSide) {
    return failed(Failure::kInvalidInput, "The costmap has " + std::to_string(g.width) + " x " +
                                              std::to_string(g.height) +
                                              " cells, legal: sides of up to 65000.");
  }
  return std::nullopt;
}

}  // namespace

std::string place_text(double x, double y) {
  char text[64];
  std::snprintf(text, sizeof(text), "(%.2f, %.2f)", x, y);
  return text;
}

PlanOutcome failed(Failure failure, std::string reason) {
  PlanOutcome outcome;
  outcome.failure = failure;
  outcome.reason = std::move(reason);
  return outcome;
}

std::optional<PlanOutcome> refused(const CostGrid& grid, const Pose2& start, const Pose2& goal) {
  if (auto result = refused(grid)) return result;
  const GridGeometry& g = grid.geometry;
  if (!finite(start)) return failed(Failure::kInvalidInput, "The start pose is not finite.");
  if (!finite(goal)) return failed(Failure::kInvalidInput, "The goal pose is not finite.");
  if (auto result = outside(g, start, "start", Failure::kStartOutside)) return result;
  return outside(g, goal, "goal", Failure::kGoalOutside);
}

std::vector<Cell> escape_cells(const CostGrid& grid, const StepCosts& costs, Cell start,
                               double reach_m) {
  if (!costs.blocked(grid.at(start))) return {start};
  if (grid.distance_m != nullptr) {
    std::vector<Cell> cells = climb(grid, costs, start, reach_m);
    if (!cells.empty()) return cells;
  }
  const int reach = static_cast<int>(std::ceil(reach_m / grid.geometry.resolution));
  const std::optional<Cell> exit = nearest_free(grid, costs, start, reach);
  if (!exit) return {};
  return straight(start, *exit);
}

std::vector<Cell> cells_near(const CostGrid& grid, const StepCosts& costs, const Pose2& goal,
                             double tolerance_m) {
  const GridGeometry& g = grid.geometry;
  const Cell center = g.cell(goal.x, goal.y);
  const int reach = static_cast<int>(std::ceil(tolerance_m / g.resolution));
  std::vector<std::pair<double, Cell>> found;
  for (int y = std::max(0, center.y - reach); y <= std::min(g.height - 1, center.y + reach); ++y) {
    for (int x = std::max(0, center.x - reach); x <= std::min(g.width - 1, center.x + reach); ++x) {
      const Cell c{x, y};
      const Point2 p = g.center(c);
      const double d = c == center ? 0.0 : distance(p.x, p.y, goal.x, goal.y);
      if (d <= tolerance_m && !costs.blocked(grid.at(c))) found.push_back({d, c});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Cell> cells;
  cells.reserve(found.size());
  std::transform(found.begin(), found.end(), std::back_inserter(cells),
                 [](const auto& entry) { return entry.second; });
  return cells;
}

double escape_reach(const Footprint& footprint) {
  return 2.0 * std::max(footprint.circumscribed_radius, footprint.inscribed_radius) + 1.0;
}

}  // namespace trident::nav
