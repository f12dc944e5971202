// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/core/shape_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trident::nav {
namespace {

// What a shape must reach into a cell to overlap it [cells]: more than the rounding of coordinates.
constexpr double kOverlap = 1e-7;

int first_cell(double from) { return static_cast<int>(std::floor(from + kOverlap)); }
int end_cell(double to) { return static_cast<int>(std::ceil(to - kOverlap)); }

bool is_convex(const std::vector<Point2>& corners) {
  bool has_left = false, has_right = false;
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 &a = corners[i], &b = corners[(i + 1) % n], &c = corners[(i + 2) % n];
    const double turn = (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
    has_left |= turn > 0.0;
    has_right |= turn < 0.0;
  }
  return !(has_left && has_right);
}

}  // namespace

/// Rows from the lowest to the highest corner. A convex polygon has one run a row, which is found
/// along its two sides at once; another one is intersected row by row.
const std::vector<CellRun>& ShapeCells::polygon(const GridGeometry& grid,
                                                const std::vector<Point2>& corners) {
  corners_.clear();
  runs_.clear();
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Point2& p : corners) {
    corners_.push_back(
        {(p.x - grid.origin_x) / grid.resolution, (p.y - grid.origin_y) / grid.resolution});
    least = std::min(least, corners_.back().y);
    most = std::max(most, corners_.back().y);
  }
  if (corners.empty()) return runs_;
  const int first = first_cell(least), end = end_cell(most);
  if (is_convex(corners_)) {
    add_convex(first, end);
  } else {
    for (int y = first; y < end; ++y) add_row(y);
  }
  return runs_;
}

/// The cells of a row of a convex polygon are those between the outermost parts of its edges.
void ShapeCells::add_convex(int first, int end) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  intervals_.assign(static_cast<std::size_t>(std::max(end - first, 0)), {kInfinity, -kInfinity});
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Point2 &a = corners_[i], &b = corners_[i + 1 < corners_.size() ? i + 1 : 0];
    const Point2 &low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
    const int last = std::min(end_cell(high.y), end);
    for (int y = std::max(first_cell(low.y), first); y < last; ++y) {
      const Interval part = part_in_row(y, low, high);
      Interval& row = intervals_[static_cast<std::size_t>(y - first)];
      row.from = std::min(row.from, part.from);
      row.to = std::max(row.to, part.to);
    }
  }
  for (int y = first; y < end; ++y) {
    const Interval& row = intervals_[static_cast<std::size_t>(y - first)];
    if (row.from > row.to) continue;
    const int x0 = first_cell(row.from), x1 = end_cell(row.to);
    if (x0 < x1) runs_.push_back({y, x0, x1});
  }
}

/// How far an edge, from its lower to its higher end, reaches within a row; from > to: not at all.
ShapeCells::Interval ShapeCells::part_in_row(int y, const Point2& low, const Point2& high) {
  const double bottom = std::max(low.y, y + kOverlap), top = std::min(high.y, y + 1 - kOverlap);
  if (bottom > top) return {1.0, 0.0};
  const double rise = high.y - low.y;
  if (rise <= 0.0) return {std::min(low.x, high.x), std::max(low.x, high.x)};
  const double slope = (high.x - low.x) / rise;
  const double from = low.x + (bottom - low.y) * slope, to = low.x + (top - low.y) * slope;
  return {std::min(from, to), std::max(from, to)};
}

/// A cell that a polygon overlaps has a part of an edge, or lies in the polygon with its center.
void ShapeCells::add_row(int y) {
  intervals_.clear();
  crossings_.clear();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    add_edge(y, corners_[i], corners_[i + 1 < corners_.size() ? i + 1 : 0]);
  }
  add_inside();
  merge(y);
}

void ShapeCells::add_edge(int y, const Point2& a, const Point2& b) {
  const Point2 &low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
  const Interval part = part_in_row(y, low, high);
  if (part.from <= part.to) intervals_.push_back(part);
  const double middle = y + 0.5;
  if ((low.y > middle) == (high.y > middle)) return;
  crossings_.push_back(low.x + (middle - low.y) * (high.x - low.x) / (high.y - low.y));
}

void ShapeCells::add_inside() {
  std::sort(crossings_.begin(), crossings_.end());
  for (std::size_t i = 0; i + 1 < crossings_.size(); i += 2) {
    intervals_.push_back({crossings_[i], crossings_[i + 1]});
  }
}

/// Intervals of a row that overlap or touch become one run, so that no cell is visited twice.
void ShapeCells::merge(int y) {
  std::sort(intervals_.begin(), intervals_.end(),
            [](const Interval& a, const Interval& b) { return a.from < b.from; });
  const std::size_t first = runs_.size();
  for (const Interval& interval : intervals_) {
    const int x0 = first_cell(interval.from), x1 = end_cell(interval.to);
    if (x0 >= x1) continue;
    if (runs_.size() > first && x0 <= runs_.back().x1) {
      runs_.back().x1 = std::max(runs_.back().x1, x1);
    } else {
      runs_.push_back({y, x0, x1});
    }
  }
}

/// Half the chord of a row is measured where the row comes nearest to the centre, so that every
/// cell that the disc touches counts.
const std::vector<CellRun>& ShapeCells::disc(const GridGeometry& grid, const Point2& center,
                                             double radius) {
  runs_.clear();
  const double x = (center.x - grid.origin_x) / grid.resolution;
  const double y = (center.y - grid.origin_y) / grid.resolution;
  const double r = radius / grid.resolution;
  for (int row = first_cell(y - r); row < end_cell(y + r); ++row) {
    const double away = std::max({row - y, y - (row + 1.0), 0.0});
    const double half = std::sqrt(std::max(r * r - away * away, 0.0));
    const int x0 = first_cell(x - half), x1 = end_cell(x + half);
    if (x0 < x1) runs_.push_back({row, x0, x1});
  }
  return runs_;
}

const std::vector<CellRun>& ShapeCells::footprint(const GridGeometry& grid,
                                                  const Footprint& footprint, const Pose2& pose) {
  if (footprint.points.empty()) return disc(grid, {pose.x, pose.y}, footprint.inscribed_radius);
  placed_.clear();
  for (const Point2& p : footprint.points) placed_.push_back(transform(pose, p));
  return polygon(grid, placed_);
}

}  // namespace trident::nav
