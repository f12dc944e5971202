// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "final_match.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "grids/surfel_map.h"
#include "scan_pair_edges.h"

namespace trident::slam {
namespace {

double farthest_move(const KeyframeGraph& a, const KeyframeGraph& b) {
  double farthest = 0.0;
  for (int i = 0; i < a.size(); ++i) {
    farthest = std::max(farthest, (a.pose(i).p - b.pose(i).p).norm());
  }
  return farthest;
}

}  // namespace

/// After F. Lu and E. Milios, "Globally Consistent Range Scan Alignment for Environment Mapping",
/// 1997: edges between all scans that overlap, from matches at the present poses, and again until
/// nothing moves. The graph keeps its own edges; the measured ones are returned.
std::vector<GraphEdge> align_all_keyframes(KeyframeGraph* graph, const BackEndOptions& options) {
  const std::vector<GraphEdge> edges = graph->edges();
  std::vector<GraphEdge> all;
  for (int pass = 0; pass < options.alignment.max_passes; ++pass) {
    const KeyframeGraph before = *graph;
    all = make_scan_pair_edges(*graph, options.alignment);
    for (const GraphEdge& edge : edges) {
      if (edge.kind == EdgeKind::kOdometry) all.push_back(edge);
    }
    for (GraphEdge& edge : all) edge.information *= options.alignment.information_fraction;
    graph->edges() = std::move(all);
    graph->optimize(options.optimization);
    all = std::exchange(graph->edges(), edges);
    if (farthest_move(before, *graph) < options.alignment.settled) break;
  }
  return all;
}

/// Each scan against the finished map, with its pose of the graph as a prior: poses between
/// keyframes get what the loops have corrected. Scans with few points use all of them.
std::vector<SE2> match_archive(const ScanArchive& archive, const KeyframeGraph& graph,
                               const PointScanOptions& ranges, const FinalMatchOptions& options) {
  SurfelMap surfaces;
  for (int i = 0; i < graph.size(); ++i) surfaces.insert(graph.pose(i), *graph[i].scan);
  LineMatchOptions line;
  line.search_rings = options.search_rings;
  line.converged = options.converged;
  const auto few = static_cast<std::size_t>(options.min_points);
  const auto many = static_cast<std::size_t>(options.max_points);
  PosePrior prior;
  prior.information = sigma_information(options.sigma, options.sigma_yaw);
  std::vector<SE2> poses(archive.size());
  for (std::size_t i = 0; i < archive.size(); ++i) {
    const ScanArchive::Entry& entry = archive[i];
    poses[i] = archive.pose(i, graph);
    if (!entry.is_used || !entry.has_ranges()) continue;
    prior.T_ref_base = poses[i];
    const PointScan points = make_point_scan(archive.scan(i), ranges, entry.twist.cast<double>());
    line.max_points = points.points.size() <= few ? few : many;
    poses[i] = match_lines(surfaces, points, poses[i], prior, line).T_ref_base;
  }
  return poses;
}

}  // namespace trident::slam
