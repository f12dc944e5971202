// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trident_base/se2.h"

namespace trident {

/// A planar occupancy map as nav_msgs/OccupancyGrid has it: cell (column, row) lies at
/// `cells[row * width + column]` and covers [column, column + 1) x [row, row + 1) cells from the
/// origin, x along the columns.
struct OccupancyGrid {
  static constexpr std::int8_t kUnknown = -1;    ///< never seen
  static constexpr std::int8_t kFree = 0;        ///< occupancy 0 %
  static constexpr std::int8_t kOccupied = 100;  ///< occupancy 100 %

  int width = 0;                   ///< cells along x
  int height = 0;                  ///< cells along y
  double resolution = 0.05;        ///< side of a cell [m]
  SE2 T_map_origin;                ///< the outer corner of cell (0, 0), x along the columns
  std::vector<std::int8_t> cells;  ///< occupancy [%], -1 unknown

  bool contains(int column, int row) const {  ///< whether the cell exists
    return column >= 0 && row >= 0 && column < width && row < height;
  }
  /// Index into `cells` of a cell that contains() is true for; not checked.
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
  /// The centre of a cell [m].
  Eigen::Vector2d center_in_map(int column, int row) const {
    return T_map_origin * Eigen::Vector2d((column + 0.5) * resolution, (row + 0.5) * resolution);
  }
  /// The (column, row) that holds a point [m]; may lie outside the map.
  Eigen::Vector2i cell_at(const Eigen::Vector2d& p_map) const {
    const Eigen::Vector2d p = T_map_origin.inverse() * p_map / resolution;
    return {static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))};
  }
};

}  // namespace trident
