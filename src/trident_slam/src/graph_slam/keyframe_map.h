// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "front_end/growing_grid.h"
#include "graph_slam/keyframe_graph.h"
#include "trident_base/occupancy_grid.h"

namespace trident {

/// The occupancy map of a graph's scans. Brought up to date with a graph that has only got longer,
/// it draws the new scans alone; the map is the same as one that is made at once.
class KeyframeMap {
 public:
  /// `resolution`: side of a cell [m].
  explicit KeyframeMap(double resolution) : resolution_(resolution) {}

  /// Throws Error when the map would be larger than 2^28 cells.
  OccupancyGrid update(const KeyframeGraph& graph);

 private:
  /// Beams that ended in a cell and beams that went through, halved when they run over.
  struct Counts {
    std::uint8_t passed = 0;
    std::uint8_t ended = 0;
    void add(std::uint8_t Counts::*which);
  };
  struct Drawn {
    SE2 T_map_base;
    std::shared_ptr<const PointScan> scan;
  };

  bool only_grew(const KeyframeGraph& graph) const;
  void draw(const Keyframe& keyframe);
  void count_passed(const Eigen::Vector2i& a, const Eigen::Vector2i& b);
  Eigen::Vector2i cell_at(const Eigen::Vector2d& p_map) const;
  void check_size() const;
  OccupancyGrid grid() const;

  double resolution_;
  std::vector<Drawn> drawn_;
  GrowingGrid<Counts> counts_;
  Eigen::AlignedBox2d box_;  ///< of the scanners and of what they saw [m]
};

OccupancyGrid keyframe_map(const KeyframeGraph& graph, double resolution);

}  // namespace trident
