// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "loop_worker.h"

#include <chrono>
#include <cmath>
#include <utility>

#include "graph_slam/backend/final_match.h"
#include "trident_slam/low_priority.h"

namespace trident::slam {
namespace {

/// Adds the loops, unless the rest of the graph contradicts them.
bool accept(const std::vector<GraphEdge>& loops, const BackEndOptions& options,
            KeyframeGraph* graph) {
  KeyframeGraph changed = *graph;
  for (const GraphEdge& loop : loops) changed.add_edge(loop);
  changed.optimize(options.optimization);
  for (const GraphEdge& loop : loops) {
    const Eigen::Vector3d error = edge_error(loop, changed.pose(loop.from), changed.pose(loop.to));
    if (error.head<2>().norm() > options.loop_verification.max_residual ||
        std::abs(error.z()) > options.loop_verification.max_residual_yaw)
      return false;
  }
  *graph = std::move(changed);
  return true;
}

}  // namespace

/// Adds the loops that submaps close to the graph.
std::vector<GraphEdge> LoopWorker::close_loops(const std::vector<int>& submaps,
                                               KeyframeGraph* graph) {
  std::vector<GraphEdge> found;
  for (const int submap : submaps) {
    const std::vector<GraphEdge> loops =
        closer_.search(*graph, submap, graph->distances_from(submap));
    if (loops.empty() || !accept(loops, options_, graph)) continue;
    found.insert(found.end(), loops.begin(), loops.end());
  }
  return found;
}

/// On a copy of the graph, so that mapping continues meanwhile. Without a new loop nothing is
/// optimized, and the poses stay as they are.
LoopOutcome LoopWorker::run(KeyframeGraph graph, const Job& job, double surfel_cell) {
  LoopOutcome outcome{{}, {}, SurfelMap(surfel_cell)};
  outcome.loops = close_loops(job.submaps, &graph);
  if (outcome.loops.empty() && job.realign == Realign::kNo) return outcome;
  if (job.realign == Realign::kEdges) graph.optimize(options_.optimization);
  if (job.realign == Realign::kScans) align_all_keyframes(&graph, options_);
  for (int i = 0; i < graph.size(); ++i) {
    outcome.poses.push_back(graph.pose(i));
    outcome.surfels.insert(graph.pose(i), *graph[i].scan, graph.submap_of(i));
  }
  return outcome;
}

LoopOutcome LoopWorker::search(const KeyframeGraph& graph, int submap, double surfel_cell) {
  return run(graph, {{submap}, Realign::kNo}, surfel_cell);
}

void LoopWorker::start(const KeyframeGraph& graph, double surfel_cell) {
  if (running_.valid()) return;
  if (waiting_.submaps.empty() && waiting_.realign == Realign::kNo) return;
  running_ = std::async(std::launch::async, [this, known = graph, job = std::exchange(waiting_, {}),
                                             surfel_cell]() mutable {
    lower_priority_of_this_thread();
    return run(std::move(known), job, surfel_cell);
  });
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
  waiting_ = {};
  closer_.clear();
}

}  // namespace trident::slam
