// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "submap_matcher.h"

#include <algorithm>
#include <utility>

namespace trident::slam {
namespace {

/// Keyframes farther than this from the robot do not belong to its surroundings [m].
constexpr double kReach = 8.0;
/// Of those within the reach the nearest are taken, so many at most.
constexpr std::size_t kMostKeyframes = 40;
/// The reference is made anew when the robot is so far from where it was made for [m].
constexpr double kMostAway = 2.0;
/// A match seeks no farther than this, however wide the prior is.
constexpr ScanMatcherOptions kSearch = {2.0, 1.0, 0.05};

}  // namespace

SubmapMatcher::SubmapMatcher(const std::string& name)
    : matcher_(make_scan_matcher(name, kSearch)) {}

void SubmapMatcher::use(const KeyframeGraph& graph, int keyframe) {
  matcher_->add_to_reference(graph.pose(keyframe), *graph[keyframe].scan);
  used_.push_back({keyframe, graph.pose(keyframe)});
}

bool SubmapMatcher::is_outdated(const KeyframeGraph& graph, const SurfelMap& surfaces,
                                const Eigen::Vector2d& p_map) const {
  if (graph.size() < known_ || (p_map - centre_).norm() > kMostAway) return true;
  return std::any_of(used_.begin(), used_.end(), [&](const Used& used) {
    const SE2& T = graph.pose(used.keyframe);
    return T.p != used.T_map_base.p || T.angle != used.T_map_base.angle ||
           surfaces.is_hidden(graph.stretch_of(used.keyframe));
  });
}

void SubmapMatcher::rebuild(const KeyframeGraph& graph, const SurfelMap& surfaces,
                            const Eigen::Vector2d& p_map) {
  std::vector<std::pair<double, int>> near;
  for (int i = 0; i < graph.size(); ++i) {
    const double distance = (graph.pose(i).p - p_map).norm();
    if (distance < kReach && !surfaces.is_hidden(graph.stretch_of(i)))
      near.emplace_back(distance, i);
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min(near.size(), kMostKeyframes));
  matcher_->clear_reference();
  used_.clear();
  for (const auto& [distance, keyframe] : near) use(graph, keyframe);
  centre_ = p_map;
}

MatchResult SubmapMatcher::match(const KeyframeGraph& graph, const SurfelMap& surfaces,
                                 const PointScan& scan, const SE2& guess, const PosePrior& prior) {
  const Eigen::Vector2d& here = prior.T_ref_base.p;
  if (is_outdated(graph, surfaces, here)) {
    rebuild(graph, surfaces, here);
  } else {
    for (int i = known_; i < graph.size(); ++i) use(graph, i);
  }
  known_ = graph.size();
  return matcher_->match(scan, guess, prior);
}

}  // namespace trident::slam
