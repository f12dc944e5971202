// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "path_centering.h"

#include <algorithm>
#include <cmath>

namespace trident::nav {
namespace {

// Between the centers of four cells; what is outside of the grid is far from everything.
double distance_at(const CostGrid& grid, const Point2& p) {
  const GridGeometry& g = grid.geometry;
  const double column = (p.x - g.origin_x) / g.resolution - 0.5;
  const double row = (p.y - g.origin_y) / g.resolution - 0.5;
  const Cell low{static_cast<int>(std::floor(column)), static_cast<int>(std::floor(row))};
  if (!g.contains(low) || !g.contains({low.x + 1, low.y + 1})) {
    return static_cast<double>(grid.max_distance_m);
  }
  const auto at = [&](int dx, int dy) {
    return static_cast<double>(grid.distance_m[g.index({low.x + dx, low.y + dy})]);
  };
  const double u = column - low.x;
  const double v = row - low.y;
  return (1.0 - v) * ((1.0 - u) * at(0, 0) + u * at(1, 0)) +
         v * ((1.0 - u) * at(0, 1) + u * at(1, 1));
}

struct Sidestep {
  double offset_m = 0.0;  // to the left
  double room_m = 0.0;    // distance from obstacles there
};

// To where a point has `room_m`, or to the middle; by no more than that.
Sidestep sidestep(const CostGrid& grid, double room_m, const Pose2& pose) {
  const double step_m = 0.5 * grid.geometry.resolution;
  const auto room_at = [&](double offset_m) {
    return distance_at(
        grid, {pose.x - std::sin(pose.yaw) * offset_m, pose.y + std::cos(pose.yaw) * offset_m});
  };
  const double side = room_at(step_m) >= room_at(-step_m) ? step_m : -step_m;
  Sidestep best{0.0, room_at(0.0)};
  while (best.room_m < room_m && std::fabs(best.offset_m) < room_m) {
    const double next_m = room_at(best.offset_m + side);
    if (next_m <= best.room_m) break;
    best = {best.offset_m + side, next_m};
  }
  return best;
}

// Offsets of points that are within `reach` points of a narrow place; 0 for the others.
std::vector<double> offsets_near_narrow(const std::vector<Sidestep>& steps, double narrow_m,
                                        std::size_t reach) {
  std::vector<double> offsets_m(steps.size(), 0.0);
  std::size_t filled = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].room_m >= narrow_m) continue;
    const std::size_t end = std::min(i + reach + 1, steps.size());
    for (std::size_t k = std::max(filled, i - std::min(i, reach)); k < end; ++k) {
      offsets_m[k] = steps[k].offset_m;
    }
    filled = end;
  }
  return offsets_m;
}

// The mean over as many neighbors on both sides.
std::vector<double> smoothed(const std::vector<double>& values, std::size_t reach) {
  std::vector<double> means;
  means.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t around = std::min({reach, i, values.size() - 1 - i});
    double sum = 0.0;
    for (std::size_t k = i - around; k <= i + around; ++k) sum += values[k];
    means.push_back(sum / static_cast<double>(2 * around + 1));
  }
  return means;
}

}  // namespace

void center_path(const CostGrid& grid, double narrow_m, std::vector<Pose2>* path) {
  constexpr double kLead = 2.0;  // before and behind narrow places, and aside, in `narrow_m`
  if (path->size() < 3 || grid.distance_m == nullptr) return;
  std::vector<Sidestep> steps;
  steps.reserve(path->size());
  for (const Pose2& pose : *path) steps.push_back(sidestep(grid, kLead * narrow_m, pose));
  const Pose2& a = (*path)[0];
  const Pose2& b = (*path)[1];
  const double spacing_m = std::max(distance(a.x, a.y, b.x, b.y), 1e-3);
  const auto lead = static_cast<std::size_t>(kLead * narrow_m / spacing_m);
  std::vector<double> offsets_m = offsets_near_narrow(steps, narrow_m, lead);
  offsets_m.front() = offsets_m.back() = 0.0;
  offsets_m = smoothed(offsets_m, lead / 6);
  for (std::size_t i = 0; i < path->size(); ++i) {
    Pose2& pose = (*path)[i];
    pose.x -= std::sin(pose.yaw) * offsets_m[i];
    pose.y += std::cos(pose.yaw) * offsets_m[i];
  }
  for (std::size_t i = 0; i + 1 < path->size(); ++i) {
    Pose2& pose = (*path)[i];
    const Pose2& next = (*path)[i + 1];
    pose.yaw = std::atan2(next.y - pose.y, next.x - pose.x);
  }
  path->back().yaw = (*path)[path->size() - 2].yaw;
}

}  // namespace trident::nav
