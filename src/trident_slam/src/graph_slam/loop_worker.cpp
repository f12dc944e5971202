// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_slam/loop_worker.h"

#include <chrono>
#include <cmath>
#include <utility>

namespace trident {
namespace {

/// Of reused surfaces' edges [standard deviations].
constexpr double kKernel = 3.0;
constexpr int kIterations = 20;
/// A loop that the optimised graph misses by more is not believed [m], [rad].
constexpr double kMisfit = 0.3;
constexpr double kMisfitYaw = 0.1;

/// Adds the loops, unless the rest of the graph contradicts them.
bool accept(const std::vector<GraphEdge>& loops, KeyframeGraph* graph) {
  KeyframeGraph changed = *graph;
  for (const GraphEdge& loop : loops) changed.add_edge(loop);
  changed.optimize(kKernel, kIterations);
  for (const GraphEdge& loop : loops) {
    const Eigen::Vector3d error = edge_error(loop, changed.pose(loop.from), changed.pose(loop.to));
    if (error.head<2>().norm() > kMisfit || std::abs(error.z()) > kMisfitYaw) return false;
  }
  *graph = std::move(changed);
  return true;
}

}  // namespace

LoopOutcome LoopWorker::run(KeyframeGraph graph, const std::vector<int>& stretches,
                            double surfel_cell) {
  LoopOutcome outcome{{}, {}, SurfelMap(surfel_cell)};
  for (const int stretch : stretches) {
    const std::vector<GraphEdge> loops =
        closer_.search(graph, stretch, graph.distances_from(stretch));
    if (loops.empty() || !accept(loops, &graph)) continue;
    outcome.loops.insert(outcome.loops.end(), loops.begin(), loops.end());
  }
  if (outcome.loops.empty()) return outcome;
  for (int i = 0; i < graph.size(); ++i) {
    outcome.poses.push_back(graph.pose(i));
    outcome.surfels.insert(graph.pose(i), *graph[i].scan, graph.stretch_of(i));
  }
  return outcome;
}

LoopOutcome LoopWorker::search(const KeyframeGraph& graph, int stretch, double surfel_cell) {
  return run(graph, {stretch}, surfel_cell);
}

void LoopWorker::start(const KeyframeGraph& graph, int stretch, double surfel_cell) {
  waiting_.push_back(stretch);
  if (running_.valid()) return;
  running_ =
      std::async(std::launch::async, [this, graph, stretches = std::exchange(waiting_, {}),
                                      surfel_cell] { return run(graph, stretches, surfel_cell); });
}

std::optional<LoopOutcome> LoopWorker::take() {
  if (!running_.valid() ||
      running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return std::nullopt;
  }
  return running_.get();
}

void LoopWorker::wait() {
  if (running_.valid()) running_.wait();
}

void LoopWorker::clear() {
  if (running_.valid()) running_.get();
  waiting_.clear();
  closer_.clear();
}

}  // namespace trident
