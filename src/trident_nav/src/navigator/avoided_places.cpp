// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/navigator/avoided_places.h"

#include <algorithm>
#include <cmath>

namespace trident::nav {
namespace {

// A robot that does not fit is stopped no farther before a place than so many of its radii.
constexpr double kRadiiAhead = 5.0;
// Revisions of grids with places differ from those without.
constexpr std::uint64_t kOwnRevisions = 1ULL << 63U;

double room_at(const CostGrid& grid, const Pose2& pose) {
  const Cell cell = grid.geometry.cell(pose.x, pose.y);
  if (!grid.geometry.contains(cell)) return static_cast<double>(grid.max_distance_m);
  return static_cast<double>(grid.distance_m[grid.geometry.index(cell)]);
}

}  // namespace

/// Of a part of a path, where obstacles are nearer than two radii.
std::optional<AvoidedPlaces::Disc> AvoidedPlaces::tightest(const CostGrid& grid, const Path& ahead,
                                                           double radius_m) {
  double walked_m = 0.0, least_m = 2.0 * radius_m;
  std::optional<Disc> found;
  for (std::size_t i = 1; i < ahead.size() && walked_m < kRadiiAhead * radius_m; ++i) {
    walked_m += distance(ahead[i - 1].x, ahead[i - 1].y, ahead[i].x, ahead[i].y);
    const double room_m = room_at(grid, ahead[i]);
    if (room_m >= least_m) continue;
    least_m = room_m;
    found = Disc{{ahead[i].x, ahead[i].y}, radius_m};
  }
  return found;
}

void AvoidedPlaces::add(const CostGrid& grid, const Footprint& footprint, const Path& ahead) {
  if (ahead.empty() || grid.distance_m == nullptr) return;
  const std::optional<Disc> place = tightest(grid, ahead, footprint.circumscribed_radius);
  if (place) places_.push_back(*place);
}

bool AvoidedPlaces::is_kept(const CostGrid& grid) const {
  return grid.revision != 0 && grid.revision == copy_.source_revision &&
         grid.cost == copy_.source && grid.geometry == copy_.geometry;
}

// A grid that has not changed is not copied again: only the cells of the places are set again, and
// the copy keeps its revision when they are the same.
void AvoidedPlaces::follow(const CostGrid& grid, const Pose2& start) {
  const bool kept = is_kept(grid);
  std::vector<std::size_t> before;
  if (kept) {
    before.swap(copy_.blocked);
    for (const std::size_t i : before) copy_.cost[i] = grid.cost[i];
  } else {
    copy_.cost.assign(grid.cost, grid.cost + grid.geometry.size());
    copy_.blocked.clear();
    copy_.source = grid.cost;
    copy_.geometry = grid.geometry;
    copy_.source_revision = grid.revision;
  }
  for (const Disc& disc : places_) block(disc, start);
  if (!kept || before != copy_.blocked) ++copy_.revision;
}

/// What is within the robot's reach at the start stays as it is, so that it can leave; and the near
/// half of a place that it is in.
bool AvoidedPlaces::stays_open(const Disc& disc, const Pose2& start, const Point2& p) {
  if (distance(p.x, p.y, start.x, start.y) < 0.5 * disc.radius_m) return true;
  const Point2 to_start{start.x - disc.center.x, start.y - disc.center.y};
  const bool is_inside = std::hypot(to_start.x, to_start.y) < disc.radius_m;
  const double near = (p.x - disc.center.x) * to_start.x + (p.y - disc.center.y) * to_start.y;
  return is_inside && near > 0.0;
}

void AvoidedPlaces::block(const Disc& disc, const Pose2& start) {
  const GridGeometry& geometry = copy_.geometry;
  const double r = disc.radius_m;
  const Cell low = geometry.cell(disc.center.x - r, disc.center.y - r);
  const Cell high = geometry.cell(disc.center.x + r, disc.center.y + r);
  for (int y = std::max(low.y, 0); y <= std::min(high.y, geometry.height - 1); ++y) {
    for (int x = std::max(low.x, 0); x <= std::min(high.x, geometry.width - 1); ++x) {
      const Point2 p = geometry.center({x, y});
      if (distance(p.x, p.y, disc.center.x, disc.center.y) > r) continue;
      if (stays_open(disc, start, p)) continue;
      const std::size_t i = geometry.index({x, y});
      if (copy_.cost[i] >= kInscribedCost) continue;
      copy_.cost[i] = kInscribedCost;
      copy_.blocked.push_back(i);
    }
  }
}

PlanOutcome AvoidedPlaces::plan(Planner& planner, const CostGrid& grid, const Footprint& footprint,
                                const Pose2& start, const Pose2& goal, const MotionLimits& limits,
                                const CancelFlag& cancel) {
  if (places_.empty()) return planner.plan(grid, footprint, start, goal, limits, cancel);
  follow(grid, start);
  CostGrid around = grid;
  around.cost = copy_.cost.data();
  around.revision = kOwnRevisions | copy_.revision;
  around.row_revisions = nullptr;
  PlanOutcome outcome = planner.plan(around, footprint, start, goal, limits, cancel);
  const bool is_blocked = outcome.path.empty() && outcome.failure != Failure::kCanceled;
  if (!is_blocked) return outcome;
  places_.clear();
  return planner.plan(grid, footprint, start, goal, limits, cancel);
}

}  // namespace trident::nav
