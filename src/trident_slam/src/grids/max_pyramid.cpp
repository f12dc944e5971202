// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "max_pyramid.h"

#include <array>
#include <cmath>

namespace trident::slam {

int MaxPyramid::cell_of(double meters) const {
  return static_cast<int>(std::floor(meters / resolution_));
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

/// A Gaussian about the point over three by three cells, in 1/255. Cells keep the greatest value,
/// so that surfaces seen often do not outweigh others.
void MaxPyramid::stamp(const Eigen::Vector2d& p) {
  const int x = cell_of(p.x());
  const int y = cell_of(p.y());
  const double spread = 0.8 * resolution_;
  const auto values = [&](int cell, double at) {
    std::array<double, 3> result{};
    for (std::size_t i = 0; i < result.size(); ++i) {
      const double d = (cell + static_cast<double>(i) - 0.5) * resolution_ - at;
      result[i] = std::exp(-0.5 * d * d / (spread * spread));
    }
    return result;
  };
  const std::array<double, 3> in_x = values(x, p.x());
  const std::array<double, 3> in_y = values(y, p.y());
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      raise(x + static_cast<int>(i) - 1, y + static_cast<int>(j) - 1,
            static_cast<std::uint8_t>(255.0 * in_x[i] * in_y[j]));
    }
  }
}

void MaxPyramid::insert(const SE2& T_map_base, const PointScan& scan) {
  const Eigen::Matrix2d R = T_map_base.rotation();
  for (const SurfacePoint& point : scan.points) {
    stamp(R * point.p.cast<double>() + T_map_base.p);
  }
}

}  // namespace trident::slam
