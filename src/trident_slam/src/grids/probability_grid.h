// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "tiled_grid.h"
#include "trident_base/occupancy_grid.h"
#include "trident_base/se2.h"
#include "trident_slam/point_scan.h"

namespace trident::slam {

/// An occupancy grid of probabilities that can be asked between its cells, too. Copies share what
/// they have in common.
class ProbabilityGrid {
 public:
  /// Probabilities that a passed cell, or one where a beam ended, is occupied: below and above 0.5.
  ProbabilityGrid(double resolution, double passed, double ended);

  /// Each cell is updated once per scan: occupied where a beam ended, else free where one passed.
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
    std::int32_t last_update = 0;  ///< 2 * scan: passed; + 1: ended
  };

  Eigen::Vector2i cell_of(const Eigen::Vector2d& p_map) const;
  class Logistic;
  void pass(Logistic& logistic, TiledGrid<Cell>::Pen& pen, const Eigen::Vector2i& from,
            const Eigen::Vector2i& to);
  void update(Logistic& logistic, Cell& cell, bool is_end);

  double resolution_;
  float per_meter_;
  float log_odds_passed_;
  float log_odds_ended_;
  std::int32_t scans_ = 0;
  TiledGrid<Cell> cells_;
};

inline ProbabilityGrid::Sample ProbabilityGrid::sample(const Eigen::Vector2f& p_map) const {
  const Eigen::Vector2f at = p_map * per_meter_ - Eigen::Vector2f::Constant(0.5F);
  const Eigen::Vector2f corner(std::floor(at.x()), std::floor(at.y()));
  const Eigen::Vector2f t = at - corner;
  const int x = static_cast<int>(corner.x());
  const int y = static_cast<int>(corner.y());
  const Cell* square = cells_.square(x, y);
  constexpr int kAbove = TiledGrid<Cell>::kTileSide;
  const float p00 = square ? square[0].probability : cells_.get(x, y).probability;
  const float p10 = square ? square[1].probability : cells_.get(x + 1, y).probability;
  const float p01 = square ? square[kAbove].probability : cells_.get(x, y + 1).probability;
  const float p11 = square ? square[kAbove + 1].probability : cells_.get(x + 1, y + 1).probability;
  const float below = p00 + t.x() * (p10 - p00);
  const float above = p01 + t.x() * (p11 - p01);
  Sample sample;
  sample.value = below + t.y() * (above - below);
  sample.gradient.x() = per_meter_ * ((1.0F - t.y()) * (p10 - p00) + t.y() * (p11 - p01));
  sample.gradient.y() = per_meter_ * (above - below);
  return sample;
}

}  // namespace trident::slam
