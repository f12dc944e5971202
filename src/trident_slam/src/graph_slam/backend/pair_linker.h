// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "keyframe_graph.h"
#include "matchers/line_match.h"

namespace trident::slam {

struct PairLinkOptions {
  LineMatchOptions line;
  double reach = 4.0;           ///< keyframes at most this far apart see the same surfaces [m]
  int partners = 4;             ///< of each keyframe, besides the ones right before it
  int chain = 4;                ///< keyframes before it that a keyframe is always matched with
  double min_inliers = 0.4;     ///< fraction below which a pair is not used
  double largest_change = 0.5;  ///< a match that moves farther than this is not believed [m]
};

/// Matches each keyframe's scan against the scans of keyframes about it, all over the map, and
/// returns an edge for every pair that fits: with the chain they make one system whose solution is
/// the map in which all scans agree.
/// F. Lu and E. Milios, "Globally consistent range scan alignment", Autonomous Robots 4, 1997.
std::vector<GraphEdge> link_pairs(const KeyframeGraph& graph, const PairLinkOptions& options);

}  // namespace trident::slam
