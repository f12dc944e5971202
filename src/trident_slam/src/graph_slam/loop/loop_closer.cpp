// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "loop_closer.h"

#include <algorithm>
#include <cmath>

#include "grids/surfel_map.h"

namespace trident::slam {
namespace {

double path_length_between(const KeyframeGraph& graph, int a, int b) {
  return std::abs(graph[graph.anchor_of(a)].travelled - graph[graph.anchor_of(b)].travelled);
}

/// The transform between two submaps' anchors by the graph.
SE2 T_between(const KeyframeGraph& graph, int from, int to) {
  return graph.pose(graph.anchor_of(from)).inverse() * graph.pose(graph.anchor_of(to));
}

/// How far a candidate moves its newer submap from where it is now [m].
double residual(const KeyframeGraph& graph, const LoopCandidate& candidate) {
  return (candidate.T_older_newer.p - T_between(graph, candidate.older, candidate.newer).p).norm();
}

}  // namespace

GraphEdge loop_edge(const KeyframeGraph& graph, const LoopCandidate& candidate,
                    const LoopVerificationOptions& options) {
  GraphEdge edge;
  edge.from = graph.anchor_of(candidate.older);
  edge.to = graph.anchor_of(candidate.newer);
  edge.T_from_to = candidate.T_older_newer;
  edge.information =
      Eigen::Vector3d(options.information, options.information, options.information_yaw)
          .asDiagonal();
  edge.kind = EdgeKind::kLoop;
  return edge;
}

SearchWindow LoopCloser::window_after(double path_length) const {
  const LoopSearchOptions& search = options_.search;
  return {std::min(search.window + search.window_per_meter * path_length, options_.search_distance),
          std::min(search.window_yaw + search.window_yaw_per_meter * path_length,
                   search.max_window_yaw)};
}

// Submaps that may be where a later one is, with their distances from it; the nearest first.
std::vector<std::pair<double, int>> LoopCloser::places_near(
    const KeyframeGraph& graph, int submap, const std::vector<double>& path_lengths) const {
  std::vector<std::pair<double, int>> places;
  const Eigen::Vector2d& here = graph.pose(graph.anchor_of(submap)).p;
  for (int s = 0; s < submap; ++s) {
    if (path_lengths[s] <= options_.search.min_path_fraction * options_.reuse_distance) continue;
    const double distance = (graph.pose(graph.anchor_of(s)).p - here).norm();
    const double window = window_after(path_lengths[s]).linear;
    if (distance < options_.search.place_reach + window) places.emplace_back(distance, s);
  }
  std::sort(places.begin(), places.end());
  return places;
}

// Of neighboring submaps the nearest one stands for both, as a place comprises its neighbors.
std::vector<int> LoopCloser::candidates_near(const KeyframeGraph& graph, int submap,
                                             const std::vector<double>& path_lengths) const {
  std::vector<int> chosen;
  for (const auto& [distance, s] : places_near(graph, submap, path_lengths)) {
    const bool is_neighbor =
        std::any_of(chosen.begin(), chosen.end(), [s = s](int c) { return std::abs(c - s) <= 1; });
    if (!is_neighbor) chosen.push_back(s);
    if (static_cast<int>(chosen.size()) >= options_.search.max_candidates) break;
  }
  return chosen;
}

std::optional<CorrelativeMatch> LoopCloser::search_window(const Place& place,
                                                          const PointScan& cloud, const SE2& guess,
                                                          double path_length) const {
  const LoopSearchOptions& search = options_.search;
  MaxPyramid hits(search.resolution, search.levels);
  place.insert_into(&hits);
  return match_by_branch_and_bound(
      hits, thinned_points(cloud, static_cast<std::size_t>(search.max_points)), guess,
      window_after(path_length), search.min_response);
}

LoopCloser::Fit LoopCloser::refine(const Place& place, const SurfelMap& surfels,
                                   const PointScan& cloud, const SE2& guess) const {
  const MatchResult match = match_lines(surfels, cloud, guess, {}, options_.line);
  return {match, place.agreement(surfels, cloud, match.T_ref_base)};
}

// A direction that the surroundings leave open says nothing about a loop.
bool LoopCloser::is_accepted(const Fit& fit) const {
  return fit.agreement.ratio >= options_.min_agreement &&
         fit.agreement.overlap >= options_.verification.min_overlap &&
         !fit.match.degeneracy.is_degenerate();
}

std::optional<LoopCandidate> LoopCloser::match(const KeyframeGraph& graph, int older, int newer,
                                               double path_length) const {
  // 1. Build: the older place with its neighbors, and the newer submap as one cloud of points.
  const Place place(graph, std::max(0, older - 1), std::min(older + 1, newer - 1),
                    graph.anchor_of(older), options_.free_space);
  const PointScan cloud = submap_cloud(graph, newer, options_.search.surfel_cell);
  if (cloud.points.empty()) return std::nullopt;
  const SE2 guess = T_between(graph, older, newer);
  // 2. Search: branch and bound over the window that drift may have opened.
  const auto found = search_window(place, cloud, guess, path_length);
  if (!found) return std::nullopt;
  // 3. Refine: point to line, from the pose that was found.
  const SurfelMap surfels = place.surfels(options_.search.surfel_cell);
  Fit fit = refine(place, surfels, cloud, found->T_ref_base);
  // 4. Compare with the pose at hand: along a corridor many places fit, and one that drift has not
  // reached is as good as any.
  const Fit here = refine(place, surfels, cloud, guess);
  if (here.agreement.overlap >= options_.verification.min_overlap &&
      here.agreement.ratio + options_.verification.search_gain > fit.agreement.ratio) {
    fit = here;
  }
  // 5. Prune: no points where the other place saw free space, enough in common, no open direction.
  if (!is_accepted(fit)) return std::nullopt;
  return LoopCandidate{older, newer, fit.match.T_ref_base, path_length, fit.agreement.ratio};
}

// Mangelson et al., eq. 5: the cycle through both candidates and the path between them must close.
bool LoopCloser::is_consistent(const KeyframeGraph& graph, const LoopCandidate& a,
                               const LoopCandidate& b) const {
  const LoopVerificationOptions& limits = options_.verification;
  const double path_length =
      path_length_between(graph, a.older, b.older) + path_length_between(graph, a.newer, b.newer);
  if (path_length > limits.max_path) return false;
  const SE2 expected = T_between(graph, a.older, b.older).inverse() * a.T_older_newer *
                       T_between(graph, a.newer, b.newer);
  const SE2 error = b.T_older_newer.inverse() * expected;
  return error.p.norm() < limits.max_error + limits.error_per_meter * path_length &&
         std::abs(error.angle) < limits.max_error_yaw + limits.error_yaw_per_meter * path_length;
}

std::vector<std::size_t> LoopCloser::consistent_group(const KeyframeGraph& graph,
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

// The longer the path, the more places look like the one that is searched for. Candidates of one
// submap alone may share its error: two submaps at least must agree.
bool LoopCloser::is_enough(const std::vector<std::size_t>& group, double path_length) const {
  const LoopVerificationOptions& limits = options_.verification;
  const int needed = path_length < limits.long_path ? limits.min_group : limits.min_group_long;
  const bool has_two_submaps = std::any_of(group.begin(), group.end(), [&](std::size_t i) {
    return pending_[i].newer != pending_[group.front()].newer;
  });
  return has_two_submaps && group.size() >= static_cast<std::size_t>(needed);
}

/// A group that agrees becomes edges together, and its candidates wait no more; the others may
/// still find partners.
std::vector<GraphEdge> LoopCloser::take_edges(const KeyframeGraph& graph,
                                              const std::vector<std::size_t>& group) {
  std::vector<GraphEdge> edges;
  edges.reserve(group.size());
  for (const std::size_t i : group) {
    edges.push_back(loop_edge(graph, pending_[i], options_.verification));
  }
  std::vector<LoopCandidate> rest;
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    if (std::find(group.begin(), group.end(), i) == group.end()) rest.push_back(pending_[i]);
  }
  pending_ = std::move(rest);
  return edges;
}

/// Fast estimate and check in match(), then agreement with earlier candidates. A candidate that
/// tracking itself would have found is no loop: it has nothing to correct.
std::vector<GraphEdge> LoopCloser::search(const KeyframeGraph& graph, int submap,
                                          const std::vector<double>& path_lengths) {
  for (const int place : candidates_near(graph, submap, path_lengths)) {
    const auto candidate = match(graph, place, submap, path_lengths[place]);
    if (!candidate) continue;
    const bool is_in_reach_of_tracking =
        candidate->path_length <= options_.reuse_distance &&
        residual(graph, *candidate) < options_.verification.min_residual;
    if (is_in_reach_of_tracking) continue;
    pending_.push_back(*candidate);
    const std::vector<std::size_t> group = consistent_group(graph, pending_.size() - 1);
    if (is_enough(group, candidate->path_length)) return take_edges(graph, group);
  }
  return {};
}

}  // namespace trident::slam
