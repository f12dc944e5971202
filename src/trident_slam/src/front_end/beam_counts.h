// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "trident_base/occupancy_grid.h"

namespace trident {

/// A map by counting, for each cell, beams that ended in it and beams that went through it (the
/// reflection map of Thrun, Burgard, Fox: Probabilistic Robotics, 9.3). Counts are halved when they
/// run over, so that a cell keeps its share.
class BeamCounts {
 public:
  /// `seen`: all that beams will touch [m]. Throws Error when the map would have more than 2^28
  /// cells. Nothing seen gives a map without cells.
  BeamCounts(const Eigen::AlignedBox2d& seen, double resolution);

  void add_beam(const Eigen::Vector2d& p_map_laser, const Eigen::Vector2d& p_map_end);
  /// A cell is occupied where at least `occupied_share` of at least two beams ended, free where
  /// other beams were, else unknown.
  OccupancyGrid map(double occupied_share) const;

 private:
  struct Counts {
    std::uint8_t passed = 0;
    std::uint8_t ended = 0;
    void add(std::uint8_t Counts::*which);
  };
  Counts& at(const Eigen::Vector2i& cell) { return counts_[grid_.index(cell.x(), cell.y())]; }

  OccupancyGrid grid_;
  std::vector<Counts> counts_;
};

}  // namespace trident
