// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "loop_closer.h"

#include <algorithm>
#include <cmath>

#include "grids/surfel_map.h"
#include "matchers/correlative_match.h"
#include "place.h"
#include "trident_base/angle.h"

namespace trident::slam {
namespace {

/// Branch and bound over at most this many points.
constexpr std::size_t kSearchPoints = 300;
/// How far a scanner's surroundings reach that two places may share [m].
constexpr double kPlaceReach = 8.0;
/// Beyond these ways the drift between two candidates says nothing about them [m].
constexpr double kLongestComparison = 80.0;

/// Part of the distance of reuse from which on loops are sought, for a sensor that tells little may
/// drift out of the tracker's reach before that.
constexpr double kNearestLoop = 0.4;
/// What the tracker reaches by itself [m].
constexpr double kTrackerReach = 0.5;

double smallest_way(const KeyframeGraph& graph, int a, int b) {
  return std::abs(graph[graph.anchor_of(a)].travelled - graph[graph.anchor_of(b)].travelled);
}

SearchWindow window_after(double way, double largest) {
  return {std::min(0.5 + 0.03 * way, largest), std::min(0.1 + 0.004 * way, 1.0)};
}

/// Part of the points by which a place that was sought must fit better than where the graph has it.
constexpr double kSearchGain = 0.05;

/// How far a candidate puts its newer stretch from where it is now [m].
double misfit(const KeyframeGraph& graph, const LoopCandidate& candidate) {
  const SE2 now = graph.pose(graph.anchor_of(candidate.older)).inverse() *
                  graph.pose(graph.anchor_of(candidate.newer));
  return (candidate.T_older_newer.p - now.p).norm();
}

/// Candidates that must agree before any is believed: the longer the way, the more places look
/// like the one that is sought.
std::size_t needed_agreement(double way) { return way < 150.0 ? 2 : 3; }

}  // namespace

GraphEdge loop_edge(const KeyframeGraph& graph, const LoopCandidate& candidate) {
  GraphEdge edge;
  edge.from = graph.anchor_of(candidate.older);
  edge.to = graph.anchor_of(candidate.newer);
  edge.T_from_to = candidate.T_older_newer;
  edge.information = Eigen::Vector3d(1e3, 1e3, 1e4).asDiagonal();
  edge.kind = EdgeKind::kLoop;
  return edge;
}

std::vector<int> LoopCloser::places_near(const KeyframeGraph& graph, int stretch,
                                         const std::vector<double>& ways) const {
  std::vector<std::pair<double, int>> places;
  const Eigen::Vector2d& here = graph.pose(graph.anchor_of(stretch)).p;
  for (int s = 0; s < stretch; ++s) {
    if (ways[s] <= kNearestLoop * options_.reuse_distance) continue;
    const double distance = (graph.pose(graph.anchor_of(s)).p - here).norm();
    const double window = window_after(ways[s], options_.search_distance).linear;
    if (distance < kPlaceReach + window) places.emplace_back(distance, s);
  }
  std::sort(places.begin(), places.end());
  std::vector<int> chosen;
  for (const auto& [distance, s] : places) {
    const bool is_neighbour =
        std::any_of(chosen.begin(), chosen.end(), [s = s](int c) { return std::abs(c - s) <= 1; });
    if (!is_neighbour) chosen.push_back(s);
    if (static_cast<int>(chosen.size()) >= options_.candidates_per_stretch) break;
  }
  return chosen;
}

bool LoopCloser::match(const KeyframeGraph& graph, int older, int newer, double way,
                       LoopCandidate* candidate) const {
  const Place place(graph, std::max(0, older - 1), std::min(older + 1, newer - 1),
                    graph.anchor_of(older));
  const PointScan cloud = stretch_cloud(graph, newer, 0.1);
  if (cloud.points.empty()) return false;
  MaxPyramid hits(options_.resolution, 7);
  place.insert_into(&hits);
  const SE2 guess =
      graph.pose(graph.anchor_of(older)).inverse() * graph.pose(graph.anchor_of(newer));
  const auto found =
      match_by_branch_and_bound(hits, thinned_points(cloud, kSearchPoints), guess,
                                window_after(way, options_.search_distance), options_.min_response);
  if (!found) return false;
  const SurfelMap surfels = place.surfels(0.1);
  MatchResult match = match_lines(surfels, cloud, found->T_ref_base, {}, options_.line);
  Agreement agreement = place.agreement(surfels, cloud, match.T_ref_base);
  // Along a corridor many places fit: one that drift has not reached is as good as any.
  const MatchResult here = match_lines(surfels, cloud, guess, {}, options_.line);
  const Agreement agreement_here = place.agreement(surfels, cloud, here.T_ref_base);
  if (agreement_here.overlap >= options_.min_overlap &&
      agreement_here.ratio + kSearchGain > agreement.ratio) {
    match = here;
    agreement = agreement_here;
  }
  candidate->older = older;
  candidate->newer = newer;
  candidate->T_older_newer = match.T_ref_base;
  candidate->way = way;
  candidate->agreement = agreement.ratio;
  return agreement.ratio >= options_.min_agreement && agreement.overlap >= options_.min_overlap &&
         !match.degeneracy.is_degenerate();
}

bool LoopCloser::is_consistent(const KeyframeGraph& graph, const LoopCandidate& a,
                               const LoopCandidate& b) const {
  const double way = smallest_way(graph, a.older, b.older) + smallest_way(graph, a.newer, b.newer);
  if (way > kLongestComparison) return false;
  const auto between = [&graph](int from, int to) {
    return graph.pose(graph.anchor_of(from)).inverse() * graph.pose(graph.anchor_of(to));
  };
  const SE2 expected =
      between(a.older, b.older).inverse() * a.T_older_newer * between(a.newer, b.newer);
  const SE2 error = b.T_older_newer.inverse() * expected;
  return error.p.norm() < 0.2 + 0.01 * way && std::abs(error.angle) < 0.03 + 0.001 * way;
}

std::vector<std::size_t> LoopCloser::agreeing_with(const KeyframeGraph& graph,
                                                   std::size_t newest) const {
  std::vector<std::size_t> group = {newest};
  for (std::size_t i = newest; i-- > 0;) {
    const bool agrees = std::all_of(group.begin(), group.end(), [&](std::size_t other) {
      return is_consistent(graph, pending_[i], pending_[other]);
    });
    if (agrees) group.push_back(i);
  }
  return group;
}

std::vector<GraphEdge> LoopCloser::search(const KeyframeGraph& graph, int stretch,
                                          const std::vector<double>& ways) {
  for (const int place : places_near(graph, stretch, ways)) {
    LoopCandidate candidate;
    if (!match(graph, place, stretch, ways[place], &candidate)) continue;
    if (candidate.way <= options_.reuse_distance && misfit(graph, candidate) < kTrackerReach)
      continue;
    pending_.push_back(candidate);
    const std::vector<std::size_t> group = agreeing_with(graph, pending_.size() - 1);
    std::vector<int> newer_stretches;
    newer_stretches.reserve(group.size());
    for (const std::size_t i : group) newer_stretches.push_back(pending_[i].newer);
    std::sort(newer_stretches.begin(), newer_stretches.end());
    const auto last = std::unique(newer_stretches.begin(), newer_stretches.end());
    const auto distinct = static_cast<std::size_t>(last - newer_stretches.begin());
    if (distinct < 2 || group.size() < needed_agreement(candidate.way)) continue;
    std::vector<GraphEdge> edges;
    edges.reserve(group.size());
    for (const std::size_t i : group) edges.push_back(loop_edge(graph, pending_[i]));
    std::vector<LoopCandidate> rest;
    for (std::size_t i = 0; i < pending_.size(); ++i) {
      if (std::find(group.begin(), group.end(), i) == group.end()) rest.push_back(pending_[i]);
    }
    pending_ = std::move(rest);
    return edges;
  }
  return {};
}

}  // namespace trident::slam
