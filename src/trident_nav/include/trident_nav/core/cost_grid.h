// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// Costs of cells with a meaning of their own, as costmap_2d has them.
constexpr std::uint8_t kFreeCost = 0;
constexpr std::uint8_t kInscribedCost =
    253;  ///< The robot's center here is in contact, whatever its heading.
constexpr std::uint8_t kLethalCost = 254;  ///< An obstacle.
constexpr std::uint8_t kUnknownCost = 255;

/// A cell by its column and row; row 0 has the least y.
struct Cell {
  int x = 0;
  int y = 0;
  friend bool operator==(Cell a, Cell b) { return a.x == b.x && a.y == b.y; }
};

/// Where a grid lies: cell (x, y) covers [origin + x * resolution, origin + (x + 1) * resolution).
struct GridGeometry {
  int width = 0;            ///< Columns.
  int height = 0;           ///< Rows.
  double resolution = 0.0;  ///< [m]
  double origin_x = 0.0;    ///< Of the lower left corner of cell (0, 0) [m].
  double origin_y = 0.0;

  std::size_t size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  bool contains(Cell c) const { return c.x >= 0 && c.y >= 0 && c.x < width && c.y < height; }
  std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(c.x);
  }
  friend bool operator==(const GridGeometry& a, const GridGeometry& b) {
    return a.width == b.width && a.height == b.height && a.resolution == b.resolution &&
           a.origin_x == b.origin_x && a.origin_y == b.origin_y;
  }
  /// The cell that contains a point; may lie outside of the grid. Numbers of columns and rows end
  /// at +-kFarthestCell; a coordinate that is not a number counts as beyond the upper end.
  Cell cell(double x, double y) const {
    return {whole((x - origin_x) / resolution), whole((y - origin_y) / resolution)};
  }
  /// The center of a cell.
  Point2 center(Cell c) const {
    return {origin_x + (c.x + 0.5) * resolution, origin_y + (c.y + 0.5) * resolution};
  }
  /// Sums of a few of them, and of a grid's sides, are still whole numbers.
  static constexpr int kFarthestCell = 500'000'000;

 private:
  /// The greatest whole number not above a value. The order of the arguments takes nan to the end.
  static int whole(double value) {
    constexpr double kEnd = kFarthestCell;
    const double inside = std::max(-kEnd, std::min(kEnd, value));
    const int toward_zero = static_cast<int>(inside);
    return toward_zero - (inside < toward_zero ? 1 : 0);
  }
};

/// What planners and controllers read of a costmap: the master costs and the exact distance field.
/// Rows follow each other without gaps. Does not own the arrays, which live as long as the lock
/// that the costmap's owner holds.
struct CostGrid {
  GridGeometry geometry;
  const std::uint8_t* cost = nullptr;
  /// Distance from the center of each cell to the center of the nearest lethal one [m], cut at
  /// `max_distance_m`; nullptr: not kept.
  const float* distance_m = nullptr;
  float max_distance_m = 0.0F;
  /// Count of changes; equal numbers of one costmap mean equal contents.
  std::uint64_t revision = 0;
  /// Of each row the revision that last changed its costs; nullptr: not kept.
  const std::uint64_t* row_revisions = nullptr;

  std::uint8_t at(Cell c) const { return cost[geometry.index(c)]; }
  /// Cost at a point; kUnknownCost outside.
  std::uint8_t at(double x, double y) const {
    const Cell c = geometry.cell(x, y);
    return geometry.contains(c) ? at(c) : kUnknownCost;
  }
};

/// A polygon about the base's origin in its axes, counter-clockwise [m], and its circles.
struct Footprint {
  std::vector<Point2> points;     ///< Empty: a circle of `inscribed_radius`.
  double inscribed_radius = 0.0;  ///< Of the largest circle about the origin that lies within [m].
  double circumscribed_radius =
      0.0;  ///< Of the smallest circle about the origin that encloses it [m].
};

}  // namespace trident::nav
