// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/footprint_checker.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace trident::nav {
namespace {

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

}  // namespace

FootprintChecker::FootprintChecker(const CostGrid& grid, const Footprint& footprint)
    : grid_(grid),
      footprint_(footprint),
      half_diagonal_m_(0.5 * std::sqrt(2.0) * grid.geometry.resolution) {
  cover_footprint();
}

/// Each square of a grid over the polygon that the polygon overlaps has a disc around it.
void FootprintChecker::cover_footprint() {
  if (footprint_.points.empty()) return;
  const double reach = footprint_.circumscribed_radius;
  const double side = std::max(kSquare * footprint_.inscribed_radius, grid_.geometry.resolution);
  const int count = static_cast<int>(std::ceil(2.0 * reach / side)) + 1;
  const GridGeometry squares{count, count, side, -0.5 * count * side, -0.5 * count * side};
  for (const CellRun& run : shape_.polygon(squares, footprint_.points)) {
    for (int x = run.x0; x < run.x1; ++x) discs_.push_back(squares.center({x, run.y}));
  }
  disc_radius_m_ = 0.5 * std::sqrt(2.0) * side;
  if (discs_.size() > kMaxDiscs) discs_.clear();
}

bool FootprintChecker::is_cover_free(const Pose2& pose) const {
  if (discs_.empty()) return false;
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  const double least = disc_radius_m_ + half_diagonal_m_;
  return std::all_of(discs_.begin(), discs_.end(), [&](const Point2& p) {
    return distance_at_least({pose.x + c * p.x - s * p.y, pose.y + s * p.x + c * p.y}) > least;
  });
}

double FootprintChecker::distance_at_least(const Point2& p) const {
  const Cell cell = grid_.geometry.cell(p.x, p.y);
  if (!grid_.geometry.contains(cell) || grid_.distance_m == nullptr) return 0.0;
  const Point2 center = grid_.geometry.center(cell);
  const double distance = static_cast<double>(grid_.distance_m[grid_.geometry.index(cell)]);
  return std::max(distance - std::hypot(p.x - center.x, p.y - center.y) - kTableRounding, 0.0);
}

/// The distance d to a lethal cell's center is known from the center of the pose's cell, which is
/// `off` away from the pose. A point of the lethal cell lies as far as half a diagonal from its
/// center.
FootprintChecker::Verdict FootprintChecker::look_up(const Pose2& pose) const {
  const GridGeometry& grid = grid_.geometry;
  const Cell cell = grid.cell(pose.x, pose.y);
  if (!grid.contains(cell)) return Verdict::kLethal;
  if (grid_.distance_m == nullptr) return Verdict::kOpen;
  const double distance = static_cast<double>(grid_.distance_m[grid.index(cell)]);
  const Point2 center = grid.center(cell);
  const double off = std::hypot(pose.x - center.x, pose.y - center.y) + kTableRounding;
  if (distance - off - half_diagonal_m_ > footprint_.circumscribed_radius) return Verdict::kFree;
  const bool is_cut = distance >= static_cast<double>(grid_.max_distance_m);
  if (!is_cut && distance + off < footprint_.inscribed_radius) return Verdict::kLethal;
  return Verdict::kOpen;
}

bool FootprintChecker::is_in_contact(const Pose2& pose) {
  const Verdict verdict = look_up(pose);
  if (verdict != Verdict::kOpen) return verdict == Verdict::kLethal;
  if (is_cover_free(pose)) return false;
  const GridGeometry& grid = grid_.geometry;
  for (const CellRun& run : shape_.footprint(grid, footprint_, pose)) {
    const int x0 = std::max(run.x0, 0), x1 = std::min(run.x1, grid.width);
    if (run.y < 0 || run.y >= grid.height || x0 >= x1) continue;
    const auto count = static_cast<std::size_t>(x1 - x0);
    if (std::memchr(grid_.cost + grid.index({x0, run.y}), kLethalCost, count) != nullptr) {
      return true;
    }
  }
  return false;
}

Contact FootprintChecker::contact(const Pose2& pose) {
  const GridGeometry& grid = grid_.geometry;
  if (!grid.contains(grid.cell(pose.x, pose.y))) return Contact::kOutside;
  Contact worst = Contact::kFree;
  for (const CellRun& run : shape_.footprint(grid, footprint_, pose)) {
    if (!is_inside(run)) worst = std::max(worst, Contact::kOutside);
    const int x0 = std::max(run.x0, 0), x1 = std::min(run.x1, grid.width);
    if (run.y < 0 || run.y >= grid.height) continue;
    for (int x = x0; x < x1; ++x) {
      const std::uint8_t cost = grid_.at(Cell{x, run.y});
      if (cost == kLethalCost) return Contact::kLethal;
      if (cost == kUnknownCost) worst = std::max(worst, Contact::kUnknown);
    }
  }
  return worst;
}

std::uint8_t FootprintChecker::cost(const Pose2& pose) {
  if (look_up(pose) == Verdict::kLethal) return kLethalCost;
  std::uint8_t worst = kFreeCost;
  for (const CellRun& run : shape_.footprint(grid_.geometry, footprint_, pose)) {
    if (!is_inside(run)) return kLethalCost;
    for (int x = run.x0; x < run.x1; ++x) {
      const std::uint8_t cost = grid_.at(Cell{x, run.y});
      if (cost == kLethalCost) return kLethalCost;
      if (severity(cost) > severity(worst)) worst = cost;
    }
  }
  return worst;
}

}  // namespace trident::nav
