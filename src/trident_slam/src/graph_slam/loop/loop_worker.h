// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <future>
#include <optional>
#include <vector>

#include "graph_slam/backend/keyframe_graph.h"
#include "grids/surfel_map.h"
#include "loop_closer.h"

namespace trident::slam {

/// How much of a graph is reoptimized, loops or not.
enum class Realign {
  kNo,
  kEdges,  ///< the edges that it has
  kScans,  ///< all scans that see the same surfaces are matched with each other, too
};

/// What became of a search for loops.
struct LoopOutcome {
  std::vector<GraphEdge> loops;  ///< that were believed
  std::vector<SE2> poses;  ///< of the keyframes that the search knew; empty: nothing has changed
  SurfelMap surfels;       ///< of those keyframes at those poses
};

/// Searches for loops for submaps that are complete, at once or in a thread of its own.
class LoopWorker {
 public:
  LoopWorker(const LoopCloserOptions& loops, const BackEndOptions& options)
      : options_(options), closer_(loops) {}
  ~LoopWorker() { wait(); }
  LoopWorker(const LoopWorker&) = delete;
  LoopWorker& operator=(const LoopWorker&) = delete;

  /// Searches now.
  LoopOutcome search(const KeyframeGraph& graph, int submap, double surfel_cell);
  /// What is asked for here is begun by the next `start`.
  void ask(int submap) { waiting_.submaps.push_back(submap); }
  void ask(Realign realign) { waiting_.realign = std::max(waiting_.realign, realign); }
  /// Begins in the background what was asked for, unless something is running there.
  void start(const KeyframeGraph& graph, double surfel_cell);
  /// Something is running or its outcome has not been taken.
  bool is_busy() const { return running_.valid(); }
  /// The outcome of a search in the background that has ended.
  std::optional<LoopOutcome> take();
  void wait();
  /// Forgets what was asked for and what was found.
  void clear();

  const LoopCloser& closer() const { return closer_; }

 private:
  struct Job {
    std::vector<int> submaps;
    Realign realign = Realign::kNo;
  };

  std::vector<GraphEdge> close_loops(const std::vector<int>& submaps, KeyframeGraph* graph);
  LoopOutcome run(KeyframeGraph graph, const Job& job, double surfel_cell);

  BackEndOptions options_;
  LoopCloser closer_;
  Job waiting_;
  std::future<LoopOutcome> running_;
};

}  // namespace trident::slam
