// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "growing_grid.h"
#include "trident_base/occupancy_grid.h"

namespace trident::slam {

/// A map by counting, for each cell, beams that ended in it and beams that went through it (the
/// reflection map of Thrun, Burgard, Fox: Probabilistic Robotics, 9.3). Counts are halved when they
/// run over, so that a cell keeps its share.
class BeamCounts {
 public:
  /// `resolution`: side of a cell [m].
  explicit BeamCounts(double resolution) : resolution_(resolution) {}

  /// Beams from one place to `p_map_ends` [m]. Throws Error when the map would have more than 2^28
  /// cells.
  void add_beams(const Eigen::Vector2d& p_map_laser,
                 const std::vector<Eigen::Vector2d>& p_map_ends);
  /// A cell is occupied where at least two beams ended, and a quarter of those that touched it;
  /// free where other beams were, else unknown. Nothing seen gives a map without cells.
  OccupancyGrid map() const;

 private:
  struct Counts {
    std::uint8_t passed = 0;
    std::uint8_t ended = 0;
    void add(std::uint8_t Counts::*which);
  };
  Eigen::Vector2i cell_at(const Eigen::Vector2d& p_map) const;
  void count_passed(const Eigen::Vector2i& a, const Eigen::Vector2i& b);
  void check_size() const;

  double resolution_;
  GrowingGrid<Counts> counts_;
  Eigen::AlignedBox2d seen_;  ///< of the scanners and of what they saw [m]
};

}  // namespace trident::slam
