// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>

#include "trident_base/angle.h"
#include "trident_base/laser_scan.h"
#include "trident_base/occupancy_grid.h"
#include "trident_base/random_stream.h"
#include "trident_maps/distance_field.h"

namespace trident::estimation {

inline void fill(OccupancyGrid& grid, double x0, double y0, double x1, double y1,
                 std::int8_t value = OccupancyGrid::kOccupied) {
  const auto cell = [&grid](double meters) {
    return static_cast<int>(std::lround(meters / grid.resolution));
  };
  for (int row = cell(y0); row < cell(y1); ++row) {
    for (int column = cell(x0); column < cell(x1); ++column) {
      grid.cells[grid.index(column, row)] = value;
    }
  }
}

/// A flat of 12 m x 8 m with two rooms, a passage and furniture, nowhere like elsewhere; its origin
/// lies askew in the map.
inline OccupancyGrid test_flat() {
  OccupancyGrid grid;
  grid.width = 240;
  grid.height = 160;
  grid.resolution = 0.05;
  grid.T_map_origin = SE2::from_xy_yaw(-3.0, 20.0, 0.4);
  grid.cells.assign(240 * 160, OccupancyGrid::kFree);
  for (const double x : {0.0, 11.9}) fill(grid, x, 0.0, x + 0.1, 8.0);
  for (const double y : {0.0, 7.9}) fill(grid, 0.0, y, 12.0, y + 0.1);
  fill(grid, 7.0, 0.0, 7.1, 5.0);
  fill(grid, 7.0, 6.5, 7.1, 8.0);
  fill(grid, 1.0, 5.0, 3.5, 5.6);
  fill(grid, 4.5, 1.0, 5.0, 2.0);
  fill(grid, 9.5, 6.0, 11.0, 6.4);
  fill(grid, 8.0, 1.5, 8.8, 2.1);
  return grid;
}

/// What a lidar of 180 beams and 8 m sees from there, with Gaussian noise; beyond it infinity.
inline LaserScan test_scan(const OccupancyGrid& grid, const SE2& T_map_base, std::uint64_t number,
                           double sigma = 0.01) {
  static const RandomStream random(7, "test/scan");
  const maps::DistanceField field(grid, 2.0);
  LaserScan scan;
  scan.angle_min = -kPi;
  scan.angle_increment = 2.0 * kPi / 180.0;
  scan.range_min = 0.1;
  scan.range_max = 8.0;
  scan.T_base_laser = SE2::from_xy_yaw(0.1, 0.0, 0.2);
  const SE2 T_grid_laser = grid.T_map_origin.inverse() * T_map_base * scan.T_base_laser;
  for (std::uint32_t i = 0; i < 180; ++i) {
    const double range = field.ray(T_grid_laser.p, T_grid_laser.angle + scan.angle(i), 8.0);
    scan.ranges.push_back(range >= 8.0
                              ? std::numeric_limits<float>::infinity()
                              : static_cast<float>(range + sigma * random.normal(number, i)));
  }
  return scan;
}

}  // namespace trident::estimation
