// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "front_end/tiled_grid.h"
#include "trident_base/occupancy_grid.h"
#include "trident_base/se2.h"
#include "trident_slam/point_scan.h"

namespace trident {

/// An occupancy grid of probabilities that can be asked between its cells, too. Copies share what
/// they have in common.
class ProbabilityGrid {
 public:
  /// Probabilities that a passed cell, or one where a beam ended, is occupied: below and above 0.5.
  ProbabilityGrid(double resolution, double passed, double ended);

  /// Each cell is told once per scan: occupied where a beam ended, else free where one passed.
  void insert(const SE2& T_map_base, const PointScan& scan);

  struct Sample {
    float value = 0.5F;                                  ///< probability of being occupied
    Eigen::Vector2f gradient = Eigen::Vector2f::Zero();  ///< by the place [1/m]
  };
  /// Bilinear between the centres of four cells.
  Sample sample(const Eigen::Vector2f& p_map) const;

  double resolution() const { return resolution_; }
  /// What was never seen is unknown.
  OccupancyGrid occupancy() const;

 private:
  struct Cell {
    float log_odds = 0.0F;
    float probability = 0.5F;
    std::int32_t told = 0;  ///< 2 * scan: passed; + 1: ended
  };

  Eigen::Vector2i cell_of(const Eigen::Vector2d& p_map) const;
  void pass(const Eigen::Vector2i& from, const Eigen::Vector2i& to);
  void tell(const Eigen::Vector2i& cell, bool is_end);

  double resolution_;
  float per_metre_;
  float log_odds_passed_;
  float log_odds_ended_;
  std::int32_t scans_ = 0;
  TiledGrid<Cell> cells_;
};

}  // namespace trident
