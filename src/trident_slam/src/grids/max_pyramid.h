// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "growing_grid.h"
#include "trident_base/se2.h"
#include "trident_slam/point_scan.h"

namespace trident::slam {

/// Smeared hits of scans, and coarser levels that bound them: entry i of level h is the highest
/// value of the 2^(h+1) cells from i * 2^h on, along both axes. A point that is moved by 0 to
/// 2^h - 1 cells is therefore bounded by one look-up.
/// W. Hess et al., "Real-time loop closure in 2D LIDAR SLAM", ICRA 2016 (here with decimated
/// levels).
class MaxPyramid {
 public:
  /// `levels` counts the finest one.
  MaxPyramid(double resolution, int levels) : resolution_(resolution), levels_(levels) {}

  void insert(const SE2& T_map_base, const PointScan& scan);

  std::uint8_t bound(int level, int x, int y) const {
    return levels_[static_cast<std::size_t>(level)].get(x >> level, y >> level);
  }
  double resolution() const { return resolution_; }
  int levels() const { return static_cast<int>(levels_.size()); }
  const GrowingGrid<std::uint8_t>& level(int h) const {
    return levels_[static_cast<std::size_t>(h)];
  }
  int cell_of(double meters) const;

 private:
  void stamp(const Eigen::Vector2d& p);
  void raise(int x, int y, std::uint8_t value);

  double resolution_;
  std::vector<GrowingGrid<std::uint8_t>> levels_;
};

}  // namespace trident::slam
