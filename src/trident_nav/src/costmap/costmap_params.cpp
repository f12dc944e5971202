// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/costmap_params.h"

#include <cmath>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_nav/core/footprint.h"

namespace trident::nav {
namespace {

constexpr double kMaxCells = 1 << 30;

/// Whole cells in a length; a quotient that rounding left just below a whole number is that one.
int cells_in(double length_m, double resolution) {
  return static_cast<int>(length_m / resolution + 1e-6);
}

}  // namespace

void CostmapParams::validate() const {
  const double columns = width / resolution + 1e-6, rows = height / resolution + 1e-6;
  if (columns < 1.0 || rows < 1.0 || std::floor(columns) * std::floor(rows) > kMaxCells) {
    throw Error("width " + number_text(width) + " m and height " + number_text(height) +
                " m at resolution " + number_text(resolution) +
                " m make a grid of no cell, or of more than 2^30; both must be at least one cell");
  }
  padded_footprint();
}

GridGeometry CostmapParams::geometry() const {
  return {cells_in(width, resolution), cells_in(height, resolution), resolution, origin_x,
          origin_y};
}

Footprint CostmapParams::padded_footprint() const {
  const Footprint bare = footprint.empty() || footprint == "[]"
                             ? circle_footprint(robot_radius)
                             : polygon_footprint(parse_polygon(footprint));
  return nav::padded_footprint(bare, footprint_padding);
}

}  // namespace trident::nav
