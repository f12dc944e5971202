// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/core/footprint_checker.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace trident::nav {
namespace {

constexpr double kSqrtHalf = 0.70710678118654752;
// Distances are single-precision numbers [m].
constexpr double kTableRounding = 1e-5;
// Side of the squares that cover a footprint, in inscribed radii, and how many are worth a look.
constexpr double kSquare = 0.8;
constexpr std::size_t kMaxDiscs = 24;

/// Costs in the order in which they are worse.
int severity(std::uint8_t cost) {
  if (cost == kLethalCost) return 255;
  if (cost == kUnknownCost) return 254;
  return cost;
}

double half_diagonal(const CostGrid& grid) { return kSqrtHalf * grid.geometry.resolution; }

/// Of the calling thread; keeps its memory.
const std::vector<CellRun>& cells_of(const GridGeometry& grid, const Footprint& footprint,
                                     const Pose2& pose) {
  thread_local ShapeCells shape;
  return shape.footprint(grid, footprint, pose);
}

bool is_inside(const GridGeometry& grid, const CellRun& run) {
  return run.y >= 0 && run.y < grid.height && run.x0 >= 0 && run.x1 <= grid.width;
}

}  // namespace

FootprintChecker::FootprintChecker(const Footprint& footprint, UnknownCells unknown)
    : footprint_(footprint), unknown_(unknown) {
  cover_footprint();
}

/// Each square of a grid over the polygon that the polygon overlaps has a disc around it.
void FootprintChecker::cover_footprint() {
  if (footprint_.points.empty()) return;
  const double reach = footprint_.circumscribed_radius;
  const double side = kSquare * footprint_.inscribed_radius;
  if (!(side > 0.0) || reach > side * static_cast<double>(kMaxDiscs)) return;
  const int count = static_cast<int>(std::ceil(2.0 * reach / side)) + 1;
  const GridGeometry squares{count, count, side, -0.5 * count * side, -0.5 * count * side};
  ShapeCells shape;
  for (const CellRun& run : shape.polygon(squares, footprint_.points)) {
    for (int x = run.x0; x < run.x1; ++x) discs_.push_back(squares.center({x, run.y}));
  }
  disc_radius_m_ = kSqrtHalf * side;
  if (discs_.size() > kMaxDiscs) discs_.clear();
}

bool FootprintChecker::is_cover_free(const CostGrid& grid, const Pose2& pose) const {
  if (discs_.empty()) return false;
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  const double least = disc_radius_m_ + half_diagonal(grid);
  return std::all_of(discs_.begin(), discs_.end(), [&](const Point2& p) {
    const Point2 center{pose.x + c * p.x - s * p.y, pose.y + s * p.x + c * p.y};
    return distance_at_least(grid, center) > least;
  });
}

double distance_at_least(const CostGrid& grid, const Point2& p) {
  const Cell cell = grid.geometry.cell(p.x, p.y);
  if (!grid.geometry.contains(cell) || grid.distance_m == nullptr) return 0.0;
  const Point2 center = grid.geometry.center(cell);
  const double distance = static_cast<double>(grid.distance_m[grid.geometry.index(cell)]);
  return std::max(distance - std::hypot(p.x - center.x, p.y - center.y) - kTableRounding, 0.0);
}

/// The distance d to a lethal cell's center is known from the center of the pose's cell, which lies
/// `off` from the pose. A point of the lethal cell lies as far as half a diagonal from its
/// center.
FootprintChecker::Verdict FootprintChecker::look_up(const CostGrid& grid, const Pose2& pose) const {
  const Cell cell = grid.geometry.cell(pose.x, pose.y);
  if (!grid.geometry.contains(cell) || grid.distance_m == nullptr) return Verdict::kOpen;
  const double distance = static_cast<double>(grid.distance_m[grid.geometry.index(cell)]);
  const Point2 center = grid.geometry.center(cell);
  const double off = std::hypot(pose.x - center.x, pose.y - center.y) + kTableRounding;
  if (distance - off - half_diagonal(grid) > footprint_.circumscribed_radius) return Verdict::kFree;
  const bool is_cut = distance >= static_cast<double>(grid.max_distance_m);
  if (!is_cut && distance + off < footprint_.inscribed_radius) return Verdict::kLethal;
  return Verdict::kOpen;
}

bool FootprintChecker::is_run_free(const CostGrid& grid, const CellRun& run) const {
  const bool blocks_unknown = unknown_ == UnknownCells::kOccupied;
  if (blocks_unknown && !is_inside(grid.geometry, run)) return false;
  const int x0 = std::max(run.x0, 0), x1 = std::min(run.x1, grid.geometry.width);
  if (run.y < 0 || run.y >= grid.geometry.height || x0 >= x1) return true;
  const std::uint8_t* const first = grid.cost + grid.geometry.index({x0, run.y});
  const auto count = static_cast<std::size_t>(x1 - x0);
  if (std::memchr(first, kLethalCost, count) != nullptr) return false;
  return !blocks_unknown || std::memchr(first, kUnknownCost, count) == nullptr;
}

bool FootprintChecker::is_free(const CostGrid& grid, const Pose2& pose) const {
  const Verdict verdict = look_up(grid, pose);
  if (verdict == Verdict::kLethal) return false;
  if (unknown_ == UnknownCells::kFree) {
    if (verdict == Verdict::kFree || is_cover_free(grid, pose)) return true;
  }
  const std::vector<CellRun>& runs = cells_of(grid.geometry, footprint_, pose);
  return std::all_of(runs.begin(), runs.end(),
                     [&](const CellRun& run) { return is_run_free(grid, run); });
}

/// The worst of all cells under the footprint. A lethal one ends the search, since nothing is
/// worse.
Contact FootprintChecker::contact(const CostGrid& grid, const Pose2& pose) const {
  const GridGeometry& cells = grid.geometry;
  if (!cells.contains(cells.cell(pose.x, pose.y))) return Contact::kOutside;
  Contact worst = Contact::kFree;
  for (const CellRun& run : cells_of(cells, footprint_, pose)) {
    if (!is_inside(cells, run)) worst = std::max(worst, Contact::kOutside);
    const int x0 = std::max(run.x0, 0), x1 = std::min(run.x1, cells.width);
    if (run.y < 0 || run.y >= cells.height) continue;
    for (int x = x0; x < x1; ++x) {
      const std::uint8_t cost = grid.at(Cell{x, run.y});
      if (cost == kLethalCost) return Contact::kLethal;
      if (cost == kUnknownCost) worst = std::max(worst, Contact::kUnknown);
    }
  }
  return worst;
}

/// The highest cost under the footprint, by severity; lethal where it leaves the map. The table
/// answers most poses without looking at cells one by one.
std::uint8_t FootprintChecker::cost(const CostGrid& grid, const Pose2& pose) const {
  const GridGeometry& cells = grid.geometry;
  if (!cells.contains(cells.cell(pose.x, pose.y))) return kLethalCost;
  if (look_up(grid, pose) == Verdict::kLethal) return kLethalCost;
  std::uint8_t worst = kFreeCost;
  for (const CellRun& run : cells_of(cells, footprint_, pose)) {
    if (!is_inside(cells, run)) return kLethalCost;
    for (int x = run.x0; x < run.x1; ++x) {
      const std::uint8_t cost = grid.at(Cell{x, run.y});
      if (cost == kLethalCost) return kLethalCost;
      if (severity(cost) > severity(worst)) worst = cost;
    }
  }
  return worst;
}

}  // namespace trident::nav
