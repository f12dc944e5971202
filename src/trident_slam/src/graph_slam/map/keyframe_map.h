// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "graph_slam/backend/keyframe_graph.h"
#include "grids/beam_counts.h"

namespace trident::slam {

/// The occupancy map of a graph's scans. Brought up to date with a graph that has only got longer,
/// it draws the new scans alone; the map is the same as one that is made at once.
class KeyframeMap {
 public:
  /// `resolution`: side of a cell [m].
  explicit KeyframeMap(double resolution) : resolution_(resolution), counts_(resolution) {}

  /// Throws Error when the map would be larger than 2^28 cells.
  OccupancyGrid update(const KeyframeGraph& graph);

 private:
  struct Drawn {
    SE2 T_map_base;
    std::shared_ptr<const PointScan> scan;
  };

  bool only_grew(const KeyframeGraph& graph) const;
  void draw(const Keyframe& keyframe);

  double resolution_;
  std::vector<Drawn> drawn_;
  BeamCounts counts_;
};

OccupancyGrid keyframe_map(const KeyframeGraph& graph, double resolution);

}  // namespace trident::slam
