// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "graph_slam/local/scan_archive.h"
#include "graph_slam/local/scan_tracker.h"
#include "graph_slam/loop/loop_worker.h"
#include "keyframe_graph.h"
#include "scan_pruner.h"
#include "trident_slam/graph_slam_options.h"

namespace trident::slam {

/// The back end: adds keyframes and edges to the graph, closes loops, prunes scans in lifelong
/// mode, and keeps surfaces and pose of the tracker in step with the graph. It works on a graph, an
/// archive and a tracker that must outlive it.
class PoseGraphBackend {
 public:
  PoseGraphBackend(const GraphSlamOptions& options, KeyframeGraph* graph, ScanArchive* archive,
                   ScanTracker* tracker);

  /// Adds a scan at the tracker's pose. `travelled`: path length so far [m].
  void add_keyframe(const std::shared_ptr<const PointScan>& scan, const MatchResult& match,
                    double travelled);
  /// The next keyframe's edge to the one before it holds next to nothing: the pose was set.
  void break_path() { is_path_broken_ = graph_->size() > 0; }

  /// Applies what a search in the background has found and starts what was asked for meanwhile.
  void apply_finished_search();
  /// Waits for all searches that were asked for and applies them.
  void finish_searches();
  /// Waits for the running search and applies its outcome.
  void finish_running_search();
  /// A search is running, or its outcome has not been applied.
  bool is_busy() const { return worker_.is_busy(); }
  /// Optimizes the graph again, at once or in the background.
  void realign(Realign realign);

  /// Aligns all keyframes by all pairs of scans (Lu and Milios). Returns the edges it used.
  std::vector<GraphEdge> align();
  /// Optimizes after the user has added edges; searches that know nothing of them are dropped.
  void reoptimize();
  /// The graph has been replaced: forgets what was known of the old one and shows all of the map.
  void reset();
  /// The graph has grown by another map: rebuilds the surfaces and shows all of them.
  void rebuild();
  /// Closes loops of the submaps from keyframe `first_newer` on. Returns how many loops connect
  /// them with older keyframes.
  int close_loops_across(int first_newer);
  /// What finds the transform between two submaps.
  const LoopCloser& loop_closer() const { return worker_.closer(); }
  void set_mode(SlamMode mode) { options_.mode = mode; }

 private:
  void add_odometry_edge(int keyframe, const MatchResult& match);
  void add_revisit_edges(int keyframe, const PointScan& scan);
  void deactivate_drifted_submaps();
  void close_loops(int submap);
  void apply(LoopOutcome outcome);
  void rebuild_surfaces();
  void prune_replaced_scans();
  void remove_pruned_keyframes();

  GraphSlamOptions options_;
  KeyframeGraph* graph_;
  ScanArchive* archive_;
  ScanTracker* tracker_;
  LoopWorker worker_;
  ScanPruner scan_pruner_;
  std::vector<std::pair<int, int>> revisit_links_;  ///< submaps with an edge: (older, newer)
  bool is_path_broken_ = false;  ///< the next keyframe does not follow from the one before it
  int pruned_scans_ = 0;         ///< removed or thinned since the surfaces were built
};

}  // namespace trident::slam
