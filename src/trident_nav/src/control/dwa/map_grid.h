// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/footprint_checker.h"

namespace trident::nav {

/// A part of a costmap in which cells know how far they are from some, over free cells in steps to
/// the four neighbors.
class MapGrid {
 public:
  explicit MapGrid(UnknownCells unknown) : unknown_(unknown) {}

  /// The cells within `radius_m` of a point, cut by the grid. Throws nothing.
  void resize(const CostGrid& grid, const Point2& center, double radius_m);
  /// Distances from the cells of a path, all of them.
  void measure_from_path(const CostGrid& grid, const Path& path);
  /// Distances from the last cell of a path that is within.
  void measure_from_end(const CostGrid& grid, const Path& path);

  /// [cells]; `unreachable()` outside, in obstacles and behind them.
  float at(double x, double y) const;
  float unreachable() const { return static_cast<float>(width_ * height_ + 1); }

 private:
  void spread(const CostGrid& grid);
  bool seed(double x, double y);

  UnknownCells unknown_;
  GridGeometry geometry_;
  Cell first_;  ///< Of the part.
  int width_ = 0;
  int height_ = 0;
  std::vector<float> distance_;
  std::vector<int> front_;
};

}  // namespace trident::nav
