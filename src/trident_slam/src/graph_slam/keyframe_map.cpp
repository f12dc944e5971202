// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_slam/keyframe_map.h"

#include "front_end/beam_counts.h"

namespace trident {
namespace {

constexpr double kShareForAWall = 0.25;  // of the beams that touched a cell

template <class Use>
void for_each_beam(const KeyframeGraph& graph, const Use& use) {
  for (int i = 0; i < graph.size(); ++i) {
    const SE2& T = graph.pose(i);
    const Eigen::Matrix2d R = T.rotation();
    const Eigen::Vector2d origin = T * graph[i].scan->origin.cast<double>();
    for (const SurfacePoint& point : graph[i].scan->points) {
      use(origin, R * point.p.cast<double>() + T.p);
    }
  }
}

}  // namespace

OccupancyGrid keyframe_map(const KeyframeGraph& graph, double resolution) {
  Eigen::AlignedBox2d seen;
  for_each_beam(graph, [&](const Eigen::Vector2d& origin, const Eigen::Vector2d& end) {
    seen.extend(origin);
    seen.extend(end);
  });
  BeamCounts counts(seen, resolution);
  for_each_beam(graph, [&](const Eigen::Vector2d& origin, const Eigen::Vector2d& end) {
    counts.add_beam(origin, end);
  });
  return counts.map(kShareForAWall);
}

}  // namespace trident
