// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "front_end/max_pyramid.h"

#include <cmath>

namespace trident {

int MaxPyramid::cell_of(double metres) const {
  return static_cast<int>(std::floor(metres / resolution_));
}

void MaxPyramid::raise(int x, int y, std::uint8_t value) {
  std::uint8_t& finest = levels_.front().at(x, y);
  if (finest >= value) return;
  finest = value;
  for (int h = 1; h < levels(); ++h) {
    GrowingGrid<std::uint8_t>& level = levels_[static_cast<std::size_t>(h)];
    bool is_raised = false;
    for (int j = (y >> h) - 1; j <= y >> h; ++j) {
      for (int i = (x >> h) - 1; i <= x >> h; ++i) {
        std::uint8_t& cell = level.at(i, j);
        if (cell >= value) continue;
        cell = value;
        is_raised = true;
      }
    }
    if (!is_raised) return;  // coarser levels cover these cells
  }
}

void MaxPyramid::stamp(const Eigen::Vector2d& p) {
  const int x = cell_of(p.x());
  const int y = cell_of(p.y());
  const double spread = 0.8 * resolution_;
  for (int j = y - 1; j <= y + 1; ++j) {
    for (int i = x - 1; i <= x + 1; ++i) {
      const double dx = (i + 0.5) * resolution_ - p.x();
      const double dy = (j + 0.5) * resolution_ - p.y();
      const double value = std::exp(-0.5 * (dx * dx + dy * dy) / (spread * spread));
      raise(i, j, static_cast<std::uint8_t>(255.0 * value));
    }
  }
}

void MaxPyramid::insert(const SE2& T_map_base, const PointScan& scan) {
  for (const SurfacePoint& point : scan.points) stamp(T_map_base * point.p.cast<double>());
}

}  // namespace trident
