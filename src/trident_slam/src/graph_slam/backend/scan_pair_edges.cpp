// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_pair_edges.h"

#include <algorithm>
#include <cmath>

#include "grids/surfel_map.h"
#include "trident_base/angle.h"

namespace trident::slam {
namespace {

struct Partner {
  int keyframe;
  double distance;
};

/// Keyframes with a lower number that lie near to keyframe i: the nearest one of every submap, and
/// of those the nearest few.
std::vector<int> partners_of(const KeyframeGraph& graph, int i, const AlignmentOptions& options) {
  std::vector<int> result;
  for (int j = std::max(0, i - options.predecessors); j < i; ++j) result.push_back(j);
  std::vector<Partner> nearest;
  for (int s = 0; s <= graph.submap_of(i); ++s) {
    Partner best{-1, options.reach};
    for (int j = graph.first_of(s); j < graph.end_of(s) && j < i - options.predecessors; ++j) {
      const SE2 T = graph.pose(j).inverse() * graph.pose(i);
      const double distance = T.p.norm() + std::abs(T.angle);
      if (distance < best.distance) best = {j, distance};
    }
    if (best.keyframe >= 0) nearest.push_back(best);
  }
  const auto end =
      nearest.begin() +
      std::min<std::ptrdiff_t>(options.partners, static_cast<std::ptrdiff_t>(nearest.size()));
  std::partial_sort(nearest.begin(), end, nearest.end(),
                    [](const Partner& a, const Partner& b) { return a.distance < b.distance; });
  for (auto it = nearest.begin(); it != end; ++it) result.push_back(it->keyframe);
  return result;
}

/// The information of (x, y, yaw) in frame `from` as one in frame `to`.
Eigen::Matrix3d turned(const Eigen::Matrix3d& information, double angle) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return R.transpose() * information * R;
}

}  // namespace

std::vector<GraphEdge> make_scan_pair_edges(const KeyframeGraph& graph,
                                            const AlignmentOptions& options) {
  std::vector<std::vector<int>> matched_with(static_cast<std::size_t>(graph.size()));
  for (int i = 1; i < graph.size(); ++i) {
    for (const int j : partners_of(graph, i, options)) matched_with[j].push_back(i);
  }
  std::vector<GraphEdge> edges;
  SurfelMap reference(options.surfel_cell);
  LineMatchOptions line;
  line.max_points = static_cast<std::size_t>(options.max_points);
  line.converged = options.converged;
  line.least_paired = options.min_inliers;
  for (int j = 0; j < graph.size(); ++j) {
    if (matched_with[j].empty()) continue;
    reference.clear();
    reference.insert(SE2::identity(), *graph[j].scan);
    for (const int i : matched_with[j]) {
      const SE2 guess = graph.pose(j).inverse() * graph.pose(i);
      const MatchResult match = match_lines(reference, *graph[i].scan, guess, {}, line);
      const SE2 change = guess.inverse() * match.T_ref_base;
      if (match.inlier_fraction < options.min_inliers) continue;
      if (change.p.norm() > options.max_change || std::abs(change.angle) > options.max_change_yaw)
        continue;
      edges.push_back({j, i, match.T_ref_base, turned(match.information, match.T_ref_base.angle),
                       EdgeKind::kRevisit});
    }
  }
  return edges;
}

}  // namespace trident::slam
