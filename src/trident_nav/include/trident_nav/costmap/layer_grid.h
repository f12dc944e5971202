// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "trident_nav/core/cost_grid.h"

namespace trident::nav {

/// A distance in cells, if it is a whole number of them.
inline std::optional<int> whole_cells(double distance_m, double resolution_m) {
  constexpr double kRounding = 1e-3, kMaxCells = 1e9;  // [cells]
  const double cells = distance_m / resolution_m;
  if (!(std::abs(cells) < kMaxCells)) return std::nullopt;
  const int whole = static_cast<int>(std::lround(cells));
  return std::abs(cells - whole) > kRounding ? std::nullopt : std::optional<int>(whole);
}

/// How many cells the origin of `to` lies from that of `from`, when both have the same cells but
/// for where they begin and end: equal resolution, and a whole number of cells between them.
inline std::optional<Cell> whole_cell_offset(const GridGeometry& from, const GridGeometry& to) {
  if (from.resolution != to.resolution || from.resolution <= 0.0) return std::nullopt;
  const std::optional<int> x = whole_cells(to.origin_x - from.origin_x, from.resolution);
  const std::optional<int> y = whole_cells(to.origin_y - from.origin_y, from.resolution);
  if (!x || !y) return std::nullopt;
  return Cell{*x, *y};
}

inline bool same_cells(const GridGeometry& a, const GridGeometry& b) {
  const std::optional<Cell> offset = whole_cell_offset(a, b);
  return offset && *offset == Cell{} && a.width == b.width && a.height == b.height;
}

/// What a layer keeps of each cell of a costmap.
template <class T>
class LayerGrid {
 public:
  explicit LayerGrid(T fill = T{}) : fill_(fill) {}

  const GridGeometry& geometry() const { return geometry_; }
  const std::vector<T>& cells() const { return cells_; }
  std::vector<T>& cells() { return cells_; }
  const T* row(int y) const { return cells_.data() + geometry_.index({0, y}); }
  T fill() const { return fill_; }

  /// The value of cells that nothing is known of; those that are there keep theirs.
  void set_fill(T fill) { fill_ = fill; }
  void reset() { std::fill(cells_.begin(), cells_.end(), fill_); }

  /// Takes another geometry. Cells that lie in both keep their values: when the window rolled by
  /// whole cells they are moved, else each new cell gets what the old grid had at its center.
  void resize(const GridGeometry& geometry) {
    if (same_cells(geometry_, geometry) && !cells_.empty()) return;
    spare_.assign(geometry.size(), fill_);
    if (!cells_.empty()) {
      if (const std::optional<Cell> offset = whole_cell_offset(geometry_, geometry)) {
        move_cells(*offset, geometry);
      } else {
        sample_cells(geometry);
      }
    }
    cells_.swap(spare_);
    geometry_ = geometry;
  }

 private:
  void move_cells(Cell offset, const GridGeometry& to) {
    const int x0 = std::max(0, -offset.x), x1 = std::min(to.width, geometry_.width - offset.x);
    const int y0 = std::max(0, -offset.y), y1 = std::min(to.height, geometry_.height - offset.y);
    for (int y = y0; y < y1 && x0 < x1; ++y) {
      const T* from = cells_.data() + geometry_.index({x0 + offset.x, y + offset.y});
      std::copy(from, from + (x1 - x0), spare_.data() + to.index({x0, y}));
    }
  }
  void sample_cells(const GridGeometry& to) {
    for (int y = 0; y < to.height; ++y) {
      for (int x = 0; x < to.width; ++x) {
        const Point2 p = to.center({x, y});
        const Cell cell = geometry_.cell(p.x, p.y);
        if (geometry_.contains(cell)) spare_[to.index({x, y})] = cells_[geometry_.index(cell)];
      }
    }
  }

  GridGeometry geometry_;
  T fill_;
  std::vector<T> cells_, spare_;
};

}  // namespace trident::nav
