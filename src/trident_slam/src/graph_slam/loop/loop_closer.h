// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "graph_slam/backend/keyframe_graph.h"
#include "matchers/line_match.h"

namespace trident::slam {

struct LoopCloserOptions {
  LineMatchOptions line;
  double reuse_distance = 60.0;   ///< nearer by the graph, the tracker corrects what it reaches [m]
  double search_distance = 15.0;  ///< largest window [m]
  double min_agreement = 0.75;    ///< of the points that both places can see
  double min_overlap = 0.35;      ///< of the points, those that both places can see
  double min_response = 0.35;     ///< of the branch and bound
  int candidates_per_stretch = 4;
  double resolution = 0.1;  ///< of the branch and bound [m]
};

/// Two stretches that look like one place.
struct LoopCandidate {
  int older = 0;
  int newer = 0;
  SE2 T_older_newer;  ///< between the stretches' anchors
  double way = 0.0;   ///< between them through the graph [m]
  double agreement = 0.0;
};

/// Finds places that were seen long ago. A candidate comes from branch and bound, must not put
/// points where the other place saw free space, and is believed only with others that it is
/// consistent with, over the ways that lead from one to the other.
/// J. Mangelson et al., "Pairwise consistent measurement set maximization", ICRA 2018.
class LoopCloser {
 public:
  explicit LoopCloser(const LoopCloserOptions& options) : options_(options) {}

  /// Seeks the place of a complete stretch. `ways`: through the graph to every stretch. Returns
  /// the edges of every loop that is believed now, seldom any.
  std::vector<GraphEdge> search(const KeyframeGraph& graph, int stretch,
                                const std::vector<double>& ways);

  /// What was found but is not believed yet.
  const std::vector<LoopCandidate>& pending() const { return pending_; }
  void clear() { pending_.clear(); }

  /// The place of a stretch relative to another one, if they fit; the window is about their poses.
  bool match(const KeyframeGraph& graph, int older, int newer, double way,
             LoopCandidate* candidate) const;

 private:
  std::vector<int> places_near(const KeyframeGraph& graph, int stretch,
                               const std::vector<double>& ways) const;
  bool is_consistent(const KeyframeGraph& graph, const LoopCandidate& a,
                     const LoopCandidate& b) const;
  std::vector<std::size_t> agreeing_with(const KeyframeGraph& graph, std::size_t newest) const;

  LoopCloserOptions options_;
  std::vector<LoopCandidate> pending_;
};

/// Edge between the anchors of two stretches.
GraphEdge loop_edge(const KeyframeGraph& graph, const LoopCandidate& candidate);

}  // namespace trident::slam
