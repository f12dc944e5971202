// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "teb_obstacles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trident::nav {
namespace {

constexpr double kTieBreak = 0.02;
constexpr double kSqrtHalf = 0.70710678118654752;

/// Says of cells whether they are occupied.
class Occupancy {
 public:
  Occupancy(const CostGrid& grid, UnknownCells unknown)
      : grid_(grid), blocks_unknown_(unknown == UnknownCells::kOccupied) {}

  bool operator()(const Cell& cell) const {
    if (!grid_.geometry.contains(cell)) return true;
    const std::uint8_t cost = grid_.at(cell);
    return cost == kLethalCost || (blocks_unknown_ && cost == kUnknownCost);
  }
  // Cells within others do not matter: the rim comes first.
  bool is_on_rim(const Cell& cell) const {
    return !(*this)({cell.x - 1, cell.y}) || !(*this)({cell.x + 1, cell.y}) ||
           !(*this)({cell.x, cell.y - 1}) || !(*this)({cell.x, cell.y + 1});
  }

 private:
  const CostGrid& grid_;
  bool blocks_unknown_;
};

// Octants counter-clockwise from the base's x axis.
std::size_t octant(const Point2& p) {
  const bool is_left = p.y >= 0.0;
  const bool is_ahead = p.x >= 0.0;
  const bool is_steep = std::fabs(p.y) > std::fabs(p.x);
  const std::size_t within_quarter = is_steep ? 1 : 0;
  if (is_left) return is_ahead ? within_quarter : 3 - within_quarter;
  return is_ahead ? 7 - within_quarter : 4 + within_quarter;
}

Point2 to_base_axes(const Pose2& pose, double c, double s, const Point2& point) {
  const double dx = point.x - pose.x;
  const double dy = point.y - pose.y;
  return {c * dx + s * dy, c * dy - s * dx};
}

// The two corners that are farthest in a direction; the base itself of a circle, twice.
std::array<Point2, 2> outermost(const FootprintDistance& footprint, const Point2& direction) {
  std::array<Point2, 2> best{};
  double first = -std::numeric_limits<double>::infinity();
  double second = first;
  for (const Point2& corner : footprint.corners()) {
    const double out = corner.x * direction.x + corner.y * direction.y;
    if (out > first) {
      best[1] = best[0];
      second = first;
      best[0] = corner;
      first = out;
    } else if (out > second) {
      best[1] = corner;
      second = out;
    }
  }
  return best;
}

// The planes are placed so that the nearer corner has the exact distance.
void add_planes(const Pose2& pose, double c, double s, const FootprintDistance& footprint,
                const SignedDistance& found, double radius_m, TebNeighbors* result) {
  const Point2 direction{c * found.direction.x - s * found.direction.y,
                         s * found.direction.x + c * found.direction.y};
  const auto corners = outermost(footprint, found.direction);
  const double out = corners[0].x * found.direction.x + corners[0].y * found.direction.y;
  const double reach_m =
      direction.x * pose.x + direction.y * pose.y + out + found.distance_m - radius_m;
  for (const Point2& corner : corners) {
    result->planes[result->count++] = {corner, direction, reach_m};
  }
}

TebNeighbors neighbors_of(const Pose2& pose, const FootprintDistance& footprint,
                          const TebObstacles& obstacles, double cutoff_m) {
  std::array<double, 8> nearest;
  nearest.fill(cutoff_m);
  std::array<const Point2*, 8> found{};
  const double c = std::cos(pose.yaw);
  const double s = std::sin(pose.yaw);
  const double reach = footprint.reach_m() + cutoff_m + obstacles.radius_m;
  for (const Point2& center : obstacles.centers) {
    const double dx = center.x - pose.x;
    const double dy = center.y - pose.y;
    if (dx * dx + dy * dy > reach * reach) continue;
    const Point2 in_base{c * dx + s * dy, c * dy - s * dx};
    const std::size_t sector = octant(in_base);
    // What is farther than the nearest one by more than the footprint is wide needs no exact look.
    const double at_least = std::hypot(dx, dy) - footprint.reach_m() - obstacles.radius_m;
    if (at_least >= nearest[sector]) continue;
    const double d = footprint.to(in_base).distance_m - obstacles.radius_m;
    // Of cells along a flat side, the one in the middle: another would turn the robot.
    const double rank = d + kTieBreak * std::hypot(dx, dy);
    if (rank >= nearest[sector]) continue;
    nearest[sector] = rank;
    found[sector] = &center;
  }
  TebNeighbors result;
  result.clearance_m = std::numeric_limits<double>::infinity();
  for (const Point2* center : found) {
    if (center == nullptr) continue;
    const SignedDistance d = footprint.to(to_base_axes(pose, c, s, *center));
    result.clearance_m = std::min(result.clearance_m, d.distance_m - obstacles.radius_m);
    add_planes(pose, c, s, footprint, d, obstacles.radius_m, &result);
  }
  return result;
}

}  // namespace

void TebRegion::include(const Point2& point, double margin_m) {
  lo = {std::min(lo.x, point.x - margin_m), std::min(lo.y, point.y - margin_m)};
  hi = {std::max(hi.x, point.x + margin_m), std::max(hi.y, point.y + margin_m)};
}

TebObstacles collect_obstacles(const CostGrid& grid, const TebRegion& region,
                               UnknownCells unknown) {
  const Occupancy is_occupied(grid, unknown);
  TebObstacles obstacles;
  obstacles.radius_m = kSqrtHalf * grid.geometry.resolution;
  const Cell first = grid.geometry.cell(region.lo.x, region.lo.y);
  const Cell last = grid.geometry.cell(region.hi.x, region.hi.y);
  for (int y = std::max(first.y, 0); y <= std::min(last.y, grid.geometry.height - 1); ++y) {
    for (int x = std::max(first.x, 0); x <= std::min(last.x, grid.geometry.width - 1); ++x) {
      const Cell cell{x, y};
      if (is_occupied(cell) && is_occupied.is_on_rim(cell)) {
        obstacles.centers.push_back(grid.geometry.center(cell));
      }
    }
  }
  return obstacles;
}

std::vector<TebNeighbors> find_neighbors(const TebBand& band, const FootprintDistance& footprint,
                                         const TebObstacles& obstacles, double cutoff_m) {
  std::vector<TebNeighbors> neighbors;
  neighbors.reserve(band.size());
  for (const TebNode& node : band) {
    neighbors.push_back(neighbors_of(node.pose, footprint, obstacles, cutoff_m));
  }
  return neighbors;
}

}  // namespace trident::nav
