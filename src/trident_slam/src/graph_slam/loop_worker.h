// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>
#include <optional>
#include <vector>

#include "front_end/surfel_map.h"
#include "graph_slam/keyframe_graph.h"
#include "graph_slam/loop_closer.h"

namespace trident {

/// What became of a search for loops.
struct LoopOutcome {
  std::vector<GraphEdge> loops;  ///< that were believed; empty: nothing has changed
  std::vector<SE2> poses;        ///< of the keyframes that the search knew, optimised
  SurfelMap surfels;             ///< of those keyframes at those poses
};

/// Seeks loops for stretches that are complete, at once or in a thread of its own.
class LoopWorker {
 public:
  explicit LoopWorker(const LoopCloserOptions& options) : closer_(options) {}
  ~LoopWorker() { wait(); }
  LoopWorker(const LoopWorker&) = delete;
  LoopWorker& operator=(const LoopWorker&) = delete;

  /// Searches now.
  LoopOutcome search(const KeyframeGraph& graph, int stretch, double surfel_cell);
  /// Searches in the background; a stretch that comes while a search is on waits for the next one.
  void start(const KeyframeGraph& graph, int stretch, double surfel_cell);
  /// The outcome of a search in the background that has ended.
  std::optional<LoopOutcome> take();
  void wait();
  void clear();

  const LoopCloser& closer() const { return closer_; }

 private:
  LoopOutcome run(KeyframeGraph graph, const std::vector<int>& stretches, double surfel_cell);

  LoopCloser closer_;
  std::vector<int> waiting_;
  std::future<LoopOutcome> running_;
};

}  // namespace trident
