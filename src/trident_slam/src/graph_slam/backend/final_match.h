// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "graph_slam/local/scan_archive.h"
#include "keyframe_graph.h"
#include "trident_slam/graph_slam_back_end.h"

namespace trident::slam {

/// Moves the keyframes to where all scans that see the same surfaces agree. The graph keeps its
/// edges; returns those that it was aligned by.
std::vector<GraphEdge> align_all_keyframes(KeyframeGraph* graph, const BackEndOptions& options);

/// Matches every scan against the surfaces of all keyframes; about where its keyframe is now.
std::vector<SE2> match_archive(const ScanArchive& archive, const KeyframeGraph& graph,
                               const PointScanOptions& ranges, const FinalMatchOptions& options);

}  // namespace trident::slam
