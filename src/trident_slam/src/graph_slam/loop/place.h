// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "graph_slam/backend/keyframe_graph.h"
#include "grids/max_pyramid.h"
#include "grids/surfel_map.h"
#include "trident_slam/graph_slam_back_end.h"

namespace trident::slam {

/// How what one place shows fits to what another one has seen.
struct Agreement {
  double ratio = 0.0;    ///< points on surfaces, of those on surfaces or in free space
  double overlap = 0.0;  ///< points on surfaces or in free space, of all
};

/// A few submaps of a map in the frame of one keyframe, and what they saw: surfaces, and free
/// space before them.
class Place {
 public:
  /// Submaps `first` to `last`, both included.
  Place(const KeyframeGraph& graph, int first, int last, int anchor,
        const FreeSpaceOptions& options);
  /// Some keyframes, in the map's frame.
  Place(const KeyframeGraph& graph, const std::vector<int>& keyframes,
        const FreeSpaceOptions& options);

  void insert_into(MaxPyramid* hits) const;
  SurfelMap surfels(double cell) const;
  Agreement agreement(const SurfelMap& surfels, const PointScan& cloud,
                      const SE2& T_place_cloud) const;

 private:
  void add(const PointScan& scan, const SE2& T_place_base);

  /// Ranges about one scanner, by direction.
  struct View {
    SE2 T_view_place;
    std::vector<float> nearest;  ///< of the returns in each direction [m], 0: none
  };

  bool is_seen_free(const Eigen::Vector2d& p_place) const;

  struct PlacedScan {
    SE2 T_place_base;
    const PointScan* scan;
  };
  FreeSpaceOptions options_;
  std::vector<PlacedScan> scans_;
  std::vector<View> views_;
};

/// The points of a submap in its anchor's frame, one per cell [m].
PointScan submap_cloud(const KeyframeGraph& graph, int submap, double cell);

}  // namespace trident::slam
