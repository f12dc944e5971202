// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_slam/keyframe_graph.h"

#include <limits>
#include <queue>
#include <utility>

#include "trident_slam/pose_graph_optimizer.h"

namespace trident {

int KeyframeGraph::add(const Keyframe& keyframe) {
  keyframes_.push_back(keyframe);
  return size() - 1;
}

std::vector<double> KeyframeGraph::distances_from(int stretch) const {
  const std::size_t count = static_cast<std::size_t>(stretches());
  std::vector<std::vector<std::pair<int, double>>> neighbours(count);
  for (std::size_t s = 1; s < count; ++s) {
    const int at = static_cast<int>(s);
    const double way = (*this)[anchor_of(at)].travelled - (*this)[anchor_of(at - 1)].travelled;
    neighbours[s].emplace_back(at - 1, way);
    neighbours[s - 1].emplace_back(at, way);
  }
  for (const GraphEdge& edge : edges_) {
    if (edge.kind == EdgeKind::kChain) continue;
    neighbours[stretch_of(edge.from)].emplace_back(stretch_of(edge.to), 1.0);
    neighbours[stretch_of(edge.to)].emplace_back(stretch_of(edge.from), 1.0);
  }
  std::vector<double> distances(count, std::numeric_limits<double>::infinity());
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  distances[stretch] = 0.0;
  queue.emplace(0.0, stretch);
  while (!queue.empty()) {
    const auto [distance, at] = queue.top();
    queue.pop();
    if (distance > distances[at]) continue;
    for (const auto& [next, way] : neighbours[at]) {
      if (distance + way >= distances[next]) continue;
      distances[next] = distance + way;
      queue.emplace(distances[next], next);
    }
  }
  return distances;
}

Eigen::Vector3d edge_error(const GraphEdge& edge, const SE2& T_map_from, const SE2& T_map_to) {
  return (edge.T_from_to.inverse() * T_map_from.inverse() * T_map_to).log();
}

void KeyframeGraph::optimize(double kernel, int iterations) {
  if (size() < 2) return;
  PoseGraph2d graph;
  for (int i = 0; i < size(); ++i) graph.add_vertex(i, pose(i));
  graph.set_fixed(0, true);
  for (const GraphEdge& edge : edges_) {
    const bool is_chain = edge.kind == EdgeKind::kChain;
    graph.add_edge({edge.from, edge.to, edge.T_from_to, edge.information,
                    is_chain ? RobustKernel::kNone : RobustKernel::kCauchy, kernel, is_chain});
  }
  PoseGraphOptions options;
  options.max_iterations = iterations;
  PoseGraphOptimizer<SE2>(options).optimize(graph);
  for (int i = 0; i < size(); ++i) set_pose(i, graph.pose(i));
}

}  // namespace trident
