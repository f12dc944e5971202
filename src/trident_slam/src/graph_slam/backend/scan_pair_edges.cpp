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

/// Of each submap the nearest keyframe to keyframe i within reach; its predecessors do not count.
std::vector<Partner> nearest_of_submaps(const KeyframeGraph& graph, int i,
                                        const AlignmentOptions& options) {
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
  return nearest;
}

/// Keyframes with a lower number that lie near to keyframe i: the nearest one of every submap, and
/// of those the nearest few.
std::vector<int> partners_of(const KeyframeGraph& graph, int i, const AlignmentOptions& options) {
  std::vector<int> result;
  for (int j = std::max(0, i - options.predecessors); j < i; ++j) result.push_back(j);
  std::vector<Partner> nearest = nearest_of_submaps(graph, i, options);
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

/// For each keyframe the later ones that it is a partner of.
std::vector<std::vector<int>> later_partners(const KeyframeGraph& graph,
                                             const AlignmentOptions& options) {
  std::vector<std::vector<int>> later(static_cast<std::size_t>(graph.size()));
  for (int i = 1; i < graph.size(); ++i) {
    for (const int j : partners_of(graph, i, options)) later[j].push_back(i);
  }
  return later;
}

/// A match of few points, or one that leads far away.
bool is_doubtful(const MatchResult& match, const SE2& guess, const AlignmentOptions& options) {
  const SE2 change = guess.inverse() * match.T_ref_base;
  return match.inlier_fraction < options.min_inliers || change.p.norm() > options.max_change ||
         std::abs(change.angle) > options.max_change_yaw;
}

}  // namespace

/// Each keyframe with later partners is a reference once, so that its surfaces are prepared once
/// for all of them. A match that has gone far from its guess or fits badly gives no edge.
std::vector<GraphEdge> make_scan_pair_edges(const KeyframeGraph& graph,
                                            const AlignmentOptions& options) {
  const std::vector<std::vector<int>> matched_with = later_partners(graph, options);
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
      if (is_doubtful(match, guess, options)) continue;
      edges.push_back({j, i, match.T_ref_base, turned(match.information, match.T_ref_base.angle),
                       EdgeKind::kRevisit});
    }
  }
  return edges;
}

}  // namespace trident::slam
