// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/obstacle_layer.h"

#include <cmath>

#include "../beams/ray_walk.h"

namespace trident::nav {

ObstacleLayer::ObstacleLayer(const LayerSetup& setup) : BeamLayer(setup, setup.params<Params>()) {}

void ObstacleLayer::clear_beams(const Observation& observation, const Reach& reach) {
  for (const BeamGroup& group : observation.groups) {
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
      clear_beam(group, observation.ends[i], reach);
    }
  }
}

void ObstacleLayer::clear_beam(const BeamGroup& group, const BeamEnd& end, const Reach& reach) {
  const GridGeometry& grid = geometry();
  const double dx = static_cast<double>(end.p.x()), dy = static_cast<double>(end.p.y());
  const double length = std::sqrt(dx * dx + dy * dy), per_cell = 1.0 / grid.resolution;
  RayPart ray{(group.origin.x() - grid.origin_x) * per_cell,
              (group.origin.y() - grid.origin_y) * per_cell, dx * per_cell, dy * per_cell};
  ray.clip_length(length, reach.clear_from_m, reach.clear_to_m);
  ray.clip(group.origin.z(), static_cast<double>(end.p.z()), reach.low_m, reach.high_m);
  // An end within the heights of obstacles is one, whatever its distance.
  const bool ends_on_obstacle = end.is_hit && reach.is_marking && ray.t1 == 1.0;
  ray.clip_to(grid.width, grid.height);
  if (ray.empty()) return;
  const std::uint8_t* cost = costs();
  walk_cells(ray, grid.width, ends_on_obstacle && ray.t1 == 1.0, [&](std::size_t cell) {
    if (cost[cell] != kFreeCost) set_cost(cell, kFreeCost);
  });
}

void ObstacleLayer::mark_ends(const Observation& observation, const Reach& reach, double now_s) {
  const GridGeometry& grid = geometry();
  for (const BeamGroup& group : observation.groups) {
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
      const BeamEnd& end = observation.ends[i];
      const double z = group.origin.z() + static_cast<double>(end.p.z());
      if (!end.is_hit || z < reach.low_m || z > reach.high_m) continue;
      const double range = static_cast<double>(end.p.norm());
      if (range < reach.mark_from_m || range >= reach.mark_to_m) continue;
      const Cell cell = grid.cell(group.origin.x() + static_cast<double>(end.p.x()),
                                  group.origin.y() + static_cast<double>(end.p.y()));
      if (grid.contains(cell)) mark(grid.index(cell), now_s);
    }
  }
}

TRIDENT_COSTMAP_LAYER(obstacle_layer, "ObstacleLayer", ObstacleLayer)

}  // namespace trident::nav
