// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trident_nav/core/cost_grid.h"
#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// Cells [x0, x1) of row y.
struct CellRun {
  int y = 0;
  int x0 = 0;
  int x1 = 0;
};

/// Which cells a shape overlaps, exactly: those whose square has more than an edge or a corner in
/// common with the shape's inside. The runs may lie outside of the grid; they are ordered by rows,
/// and do not overlap. Keeps its memory from call to call.
class ShapeCells {
 public:
  /// Of a simple polygon in the grid's frame [m].
  const std::vector<CellRun>& polygon(const GridGeometry& grid, const std::vector<Point2>& corners);
  /// Of a disc in the grid's frame [m].
  const std::vector<CellRun>& disc(const GridGeometry& grid, const Point2& center, double radius);
  /// Of a footprint with its base at a pose.
  const std::vector<CellRun>& footprint(const GridGeometry& grid, const Footprint& footprint,
                                        const Pose2& pose);

 private:
  /// [from, to] in cells along a row.
  struct Interval {
    double from, to;
  };

  static Interval part_in_row(int y, const Point2& low, const Point2& high);
  void add_convex(int first, int end);
  void add_row(int y);
  void add_edge(int y, const Point2& a, const Point2& b);
  void add_inside();
  void merge(int y);

  std::vector<Point2> placed_;   // of a footprint [m]
  std::vector<Point2> corners_;  // in cells
  std::vector<Interval> intervals_;
  std::vector<double> crossings_;
  std::vector<CellRun> runs_;
};

}  // namespace trident::nav
