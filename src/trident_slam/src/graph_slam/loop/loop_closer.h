// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "graph_slam/backend/keyframe_graph.h"
#include "matchers/correlative_match.h"
#include "matchers/line_match.h"
#include "place.h"
#include "trident_slam/graph_slam_back_end.h"

namespace trident::slam {

/// What a LoopCloser needs of GraphSlamOptions.
struct LoopCloserOptions {
  LineMatchOptions line;                 ///< of the refinement
  double reuse_distance = 60.0;          ///< nearer by the graph, tracking corrects drift [m]
  double search_distance = 15.0;         ///< largest window [m]
  double min_agreement = 0.75;           ///< fraction of the points that both places can see
  LoopSearchOptions search;              ///< candidates and windows
  LoopVerificationOptions verification;  ///< which candidates are accepted
  FreeSpaceOptions free_space;           ///< of the scans of a place
};

/// Two submaps that look like one place.
struct LoopCandidate {
  int older = 0;
  int newer = 0;
  SE2 T_older_newer;         ///< between the submaps' anchors
  double path_length = 0.0;  ///< between them through the graph [m]
  double agreement = 0.0;
};

/// Finds places that were seen long ago. A candidate comes from branch and bound, must not put
/// points where the other place saw free space, and is believed only with others that it is
/// consistent with, over the paths that lead from one to the other.
/// J. Mangelson et al., "Pairwise consistent measurement set maximization", ICRA 2018.
class LoopCloser {
 public:
  explicit LoopCloser(const LoopCloserOptions& options) : options_(options) {}

  /// Searches for the place of a complete submap. `path_lengths` [m]: through the graph to every
  /// submap. Returns the edges of every loop that is believed now, seldom any.
  std::vector<GraphEdge> search(const KeyframeGraph& graph, int submap,
                                const std::vector<double>& path_lengths);

  /// What was found but is not believed yet.
  const std::vector<LoopCandidate>& pending() const { return pending_; }
  void clear() { pending_.clear(); }

  /// The transform between two submaps, if they fit to each other; the search window is about their
  /// poses and grows with `path_length` [m] between them. Empty if they do not fit.
  std::optional<LoopCandidate> match(const KeyframeGraph& graph, int older, int newer,
                                     double path_length) const;

 private:
  std::vector<std::pair<double, int>> places_near(const KeyframeGraph& graph, int submap,
                                                  const std::vector<double>& path_lengths) const;
  std::vector<int> candidates_near(const KeyframeGraph& graph, int submap,
                                   const std::vector<double>& path_lengths) const;
  bool is_consistent(const KeyframeGraph& graph, const LoopCandidate& a,
                     const LoopCandidate& b) const;
  std::vector<std::size_t> consistent_group(const KeyframeGraph& graph, std::size_t newest) const;

  /// A pose of the newer submap in the older place, and how well it fits there.
  struct Fit {
    MatchResult match;
    Agreement agreement;
  };
  SearchWindow window_after(double path_length) const;
  std::optional<CorrelativeMatch> search_window(const Place& place, const PointScan& cloud,
                                                const SE2& guess, double path_length) const;
  Fit refine(const Place& place, const SurfelMap& surfels, const PointScan& cloud,
             const SE2& guess) const;
  bool is_accepted(const Fit& fit) const;
  bool is_enough(const std::vector<std::size_t>& group, double path_length) const;
  std::vector<GraphEdge> take_edges(const KeyframeGraph& graph,
                                    const std::vector<std::size_t>& group);

  LoopCloserOptions options_;
  std::vector<LoopCandidate> pending_;
};

/// Edge between the anchors of two submaps.
GraphEdge loop_edge(const KeyframeGraph& graph, const LoopCandidate& candidate,
                    const LoopVerificationOptions& options);

}  // namespace trident::slam
