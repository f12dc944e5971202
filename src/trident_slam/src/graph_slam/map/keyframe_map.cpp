// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "keyframe_map.h"

namespace trident::slam {

bool KeyframeMap::only_grew(const KeyframeGraph& graph) const {
  if (static_cast<std::size_t>(graph.size()) < drawn_.size()) return false;
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    const Keyframe& keyframe = graph[static_cast<int>(i)];
    if (keyframe.scan != drawn_[i].scan || keyframe.T_map_base.p != drawn_[i].T_map_base.p ||
        keyframe.T_map_base.angle != drawn_[i].T_map_base.angle) {
      return false;
    }
  }
  return true;
}

void KeyframeMap::draw(const Keyframe& keyframe) {
  const SE2& T = keyframe.T_map_base;
  const PointScan& scan = *keyframe.scan;
  drawn_.push_back({T, keyframe.scan});
  const Eigen::Matrix2d R = T.rotation();
  std::vector<Eigen::Vector2d> ends;
  ends.reserve(scan.points.size());
  for (const SurfacePoint& point : scan.points) {
    ends.emplace_back(R * point.p.cast<double>() + T.p);
  }
  counts_.add_beams(T * scan.origin.cast<double>(), ends);
}

OccupancyGrid KeyframeMap::update(const KeyframeGraph& graph) {
  if (!only_grew(graph)) *this = KeyframeMap(resolution_);
  for (int i = static_cast<int>(drawn_.size()); i < graph.size(); ++i) draw(graph[i]);
  return counts_.map();
}

OccupancyGrid keyframe_map(const KeyframeGraph& graph, double resolution) {
  return KeyframeMap(resolution).update(graph);
}

}  // namespace trident::slam
