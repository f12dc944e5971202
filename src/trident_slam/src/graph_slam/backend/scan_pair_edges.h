// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "keyframe_graph.h"
#include "matchers/line_match.h"
#include "trident_slam/graph_slam_back_end.h"

namespace trident::slam {

/// Matches each keyframe's scan against the scans of keyframes about it, all over the map, and
/// returns an edge for every pair that fits: with the chain they make one system whose solution is
/// the map in which all scans agree.
/// F. Lu and E. Milios, "Globally consistent range scan alignment", Autonomous Robots 4, 1997.
std::vector<GraphEdge> make_scan_pair_edges(const KeyframeGraph& graph,
                                            const AlignmentOptions& options);

}  // namespace trident::slam
