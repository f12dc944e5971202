// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "control/grid_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "trident_maps/distance_field.h"

namespace trident::nav::testing {
namespace {

constexpr float kMaxDistance = 3.0F;  // [m]

Path backtracked(const GridGeometry& geometry, const std::vector<int>& parent, std::size_t end) {
  Path path;
  const auto width = static_cast<std::size_t>(geometry.width);
  for (auto i = static_cast<int>(end); i >= 0; i = parent[static_cast<std::size_t>(i)]) {
    const auto index = static_cast<std::size_t>(i);
    const Point2 p =
        geometry.center({static_cast<int>(index % width), static_cast<int>(index / width)});
    path.push_back({p.x, p.y, 0.0});
  }
  std::reverse(path.begin(), path.end());
  return path;
}

void smooth(const CostGrid& grid, double least_m, Path* path) {
  for (int round = 0; round < 60; ++round) {
    for (std::size_t i = 1; i + 1 < path->size(); ++i) {
      const Pose2& a = (*path)[i - 1];
      const Pose2& b = (*path)[i + 1];
      Pose2 middle{0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.0};
      const Cell cell = grid.geometry.cell(middle.x, middle.y);
      const Cell old = grid.geometry.cell((*path)[i].x, (*path)[i].y);
      const float d = grid.distance_m[grid.geometry.index(cell)];
      if (d >= least_m || d >= grid.distance_m[grid.geometry.index(old)]) (*path)[i] = middle;
    }
  }
}

void set_headings(Path* path) {
  for (std::size_t i = 0; i + 1 < path->size(); ++i) {
    (*path)[i].yaw = std::atan2((*path)[i + 1].y - (*path)[i].y, (*path)[i + 1].x - (*path)[i].x);
  }
}

}  // namespace

GridWorld::GridWorld(double width_m, double height_m, double resolution) {
  geometry_ = {static_cast<int>(std::lround(width_m / resolution)),
               static_cast<int>(std::lround(height_m / resolution)), resolution, 0.0, 0.0};
  cost_.assign(geometry_.size(), kFreeCost);
  measure();
}

void GridWorld::fill(const Block& block, std::uint8_t cost) {
  for (int y = 0; y < geometry_.height; ++y) {
    for (int x = 0; x < geometry_.width; ++x) {
      const Point2 p = geometry_.center({x, y});
      const bool is_in = p.x > block.x0 && p.x < block.x1 && p.y > block.y0 && p.y < block.y1;
      if (is_in) cost_[geometry_.index({x, y})] = cost;
    }
  }
  measure();
}

void GridWorld::measure() {
  OccupancyGrid occupancy;
  occupancy.width = geometry_.width;
  occupancy.height = geometry_.height;
  occupancy.resolution = geometry_.resolution;
  for (const std::uint8_t cost : cost_) {
    occupancy.cells.push_back(cost == kLethalCost ? OccupancyGrid::kOccupied
                                                  : OccupancyGrid::kFree);
  }
  const maps::DistanceField field(occupancy, static_cast<double>(kMaxDistance));
  distance_m_.clear();
  for (int y = 0; y < geometry_.height; ++y) {
    const auto row = field.padded().begin() + (y + 1) * field.stride() + 1;
    distance_m_.insert(distance_m_.end(), row, row + geometry_.width);
  }
  ++revision_;
}

void GridWorld::inflate(double inscribed_radius, double inflation_radius,
                        double cost_scaling_factor) {
  for (std::size_t i = 0; i < cost_.size(); ++i) {
    const double d = static_cast<double>(distance_m_[i]);
    if (cost_[i] == kLethalCost || cost_[i] == kUnknownCost || d > inflation_radius) continue;
    const double decay = std::exp(-cost_scaling_factor * (d - inscribed_radius));
    cost_[i] = d <= inscribed_radius ? kInscribedCost : static_cast<std::uint8_t>(252.0 * decay);
  }
}

CostGrid GridWorld::grid() const {
  return {geometry_, cost_.data(), distance_m_.data(), kMaxDistance, revision_};
}

Path plan_on(const CostGrid& grid, const Pose2& start, const Pose2& goal, double inscribed_radius) {
  using Entry = std::pair<double, std::size_t>;
  const GridGeometry& geometry = grid.geometry;
  std::vector<double> best(geometry.size(), std::numeric_limits<double>::infinity());
  std::vector<int> parent(geometry.size(), -1);
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const std::size_t first = geometry.index(geometry.cell(start.x, start.y));
  const std::size_t last = geometry.index(geometry.cell(goal.x, goal.y));
  best[first] = 0.0;
  open.push({0.0, first});
  const double least_m = inscribed_radius + 0.5 * geometry.resolution;
  while (!open.empty()) {
    const auto [cost, index] = open.top();
    open.pop();
    if (cost > best[index]) continue;
    if (index == last) break;
    const int x = static_cast<int>(index % static_cast<std::size_t>(geometry.width));
    const int y = static_cast<int>(index / static_cast<std::size_t>(geometry.width));
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell next{x + dx, y + dy};
        if (!geometry.contains(next)) continue;
        const std::size_t i = geometry.index(next);
        const double d = static_cast<double>(grid.distance_m[i]);
        if (d < least_m) continue;
        const double step =
            std::hypot(dx, dy) * (1.0 + std::exp(-6.0 * (d - inscribed_radius)) * 4.0);
        if (best[index] + step >= best[i]) continue;
        best[i] = best[index] + step;
        parent[i] = static_cast<int>(index);
        open.push({best[i], i});
      }
    }
  }
  if (!std::isfinite(best[last])) return {};
  Path path = backtracked(geometry, parent, last);
  path.front() = start;
  path.back() = goal;
  smooth(grid, inscribed_radius + geometry.resolution, &path);
  set_headings(&path);
  return path;
}

}  // namespace trident::nav::testing
