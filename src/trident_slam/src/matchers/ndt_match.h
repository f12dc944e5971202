// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "grids/growing_grid.h"
#include "pose_newton.h"
#include "trident_slam/point_scan.h"

namespace trident::slam {

/// The points of scans as one normal distribution per cell. Four grids, each shifted by half a
/// cell, lie over one another, so that a place is near the middle of some cell.
/// P. Biber, W. Strasser, "The normal distributions transform: a new approach to laser scan
/// matching", IROS 2003.
class NdtMap {
 public:
  /// `least_sigma` [m]: no distribution is narrower. It is what a match can begin away from.
  NdtMap(double cell, double least_sigma);

  void insert(const SE2& T_ref_base, const PointScan& scan);
  void clear();

  struct Normal {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();  ///< inverse of the covariance
  };
  static constexpr std::size_t kGrids = 4;
  /// The cell over a place in grid `g`; nullptr where fewer than `kMinPoints` points fell.
  const Normal* over(std::size_t g, const Eigen::Vector2d& p_ref) const;
  static constexpr int kMinPoints = 3;

  double cell() const { return cell_; }

 private:
  struct Cell {
    Normal normal;
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();  ///< sum of (p - mean)(p - mean)'
    int count = 0;
    bool is_changed = false;
  };
  std::array<int, 2> place(std::size_t g, const Eigen::Vector2d& p_ref) const;
  void add(std::size_t g, const Eigen::Vector2d& p_ref);
  void update_normal(Cell* cell) const;

  double cell_;
  double least_sigma_;
  std::array<GrowingGrid<std::int32_t>, kGrids> index_;  ///< 1 + place in cells_, 0: none
  std::vector<Cell> cells_;
  std::vector<std::size_t> changed_;  ///< whose distribution must be recomputed
};

/// The mean over the grids of 1 - exp(-d' S^-1 d / 2), summed over the points of a scan, with
/// analytic gradient and Hessian. `is_on_surface`, if not null, learns which points lie within two
/// standard deviations of a narrow distribution.
PoseCost ndt_cost(const NdtMap& map, const PointScan& scan, const SE2& T_ref_base,
                  std::vector<char>* is_on_surface = nullptr);

}  // namespace trident::slam
