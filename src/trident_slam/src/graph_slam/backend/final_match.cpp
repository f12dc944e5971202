// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "final_match.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "grids/surfel_map.h"
#include "pair_linker.h"

namespace trident::slam {
namespace {

constexpr std::size_t kPairPoints = 360;  // of each scan that is matched with another one
constexpr std::size_t kMapPoints = 120;   // of each that is matched with the map ...
constexpr std::size_t kFewPoints = 200;   // ... unless it has so few: then noise wants all of them
constexpr double kKernel = 3.0;           // of edges between scans [standard deviations]
constexpr int kIterations = 20;
constexpr double kConverged = 1e-3;  // of a match [m]; the mean of many is better than that
/// Neighbouring beams, and the same surface seen again, do not err independently.
constexpr double kInformationShare = 0.1;
/// Pairs are matched again if a keyframe has moved farther [m].
constexpr double kSettled = 0.3;
constexpr int kMostPasses = 3;

double farthest_move(const KeyframeGraph& a, const KeyframeGraph& b) {
  double farthest = 0.0;
  for (int i = 0; i < a.size(); ++i) {
    farthest = std::max(farthest, (a.pose(i).p - b.pose(i).p).norm());
  }
  return farthest;
}

}  // namespace

std::vector<GraphEdge> align_all_keyframes(KeyframeGraph* graph) {
  const std::vector<GraphEdge> edges = graph->edges();
  PairLinkOptions options;
  options.line.max_points = kPairPoints;
  options.line.converged = kConverged;
  options.line.least_paired = options.min_inliers;
  std::vector<GraphEdge> all;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const KeyframeGraph before = *graph;
    all = link_pairs(*graph, options);
    for (const GraphEdge& edge : edges) {
      if (edge.kind == EdgeKind::kChain) all.push_back(edge);
    }
    for (GraphEdge& edge : all) edge.information *= kInformationShare;
    graph->edges() = std::move(all);
    graph->optimize(kKernel, kIterations);
    all = std::exchange(graph->edges(), edges);
    if (farthest_move(before, *graph) < kSettled) break;
  }
  return all;
}

std::vector<SE2> match_archive(const ScanArchive& archive, const KeyframeGraph& graph,
                               const PointScanOptions& options) {
  SurfelMap surfaces;
  for (int i = 0; i < graph.size(); ++i) surfaces.insert(graph.pose(i), *graph[i].scan);
  LineMatchOptions line;
  line.search_rings = 2;
  line.converged = kConverged;
  PosePrior prior;
  prior.information = Eigen::Vector3d(1e4, 1e4, 4e4).asDiagonal();  // 1 cm, 5 mrad
  std::vector<SE2> poses(archive.size());
  for (std::size_t i = 0; i < archive.size(); ++i) {
    const ScanArchive::Entry& entry = archive[i];
    poses[i] = archive.pose(i, graph);
    if (!entry.is_used || !entry.has_ranges()) continue;
    prior.T_ref_base = poses[i];
    const PointScan points = make_point_scan(archive.scan(i), options, entry.twist.cast<double>());
    line.max_points = points.points.size() <= kFewPoints ? kFewPoints : kMapPoints;
    poses[i] = match_lines(surfaces, points, poses[i], prior, line).T_ref_base;
  }
  return poses;
}

}  // namespace trident::slam
