// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "submap_matcher.h"

#include <algorithm>
#include <utility>

namespace trident::slam {
// A match searches no farther than `max_correction`, however wide the prior is.
SubmapMatcher::SubmapMatcher(const std::string& name, const MatcherReferenceOptions& options)
    : options_(options),
      matcher_(make_scan_matcher(
          name, {options.max_correction, options.max_correction_yaw, options.resolution})) {}

void SubmapMatcher::use(const KeyframeGraph& graph, int keyframe) {
  matcher_->add_to_reference(graph.pose(keyframe), *graph[keyframe].scan);
  used_.push_back({keyframe, graph.pose(keyframe)});
}

bool SubmapMatcher::is_outdated(const KeyframeGraph& graph, const SurfelMap& surfaces,
                                const Eigen::Vector2d& p_map) const {
  if (graph.size() < known_ || (p_map - center_).norm() > options_.max_distance) return true;
  return std::any_of(used_.begin(), used_.end(), [&](const Used& used) {
    const SE2& T = graph.pose(used.keyframe);
    return T.p != used.T_map_base.p || T.angle != used.T_map_base.angle ||
           surfaces.is_hidden(graph.submap_of(used.keyframe));
  });
}

/// The nearest keyframes about a place, up to a number: a reference that grows with the map would
/// make matching slower with every visit.
void SubmapMatcher::rebuild(const KeyframeGraph& graph, const SurfelMap& surfaces,
                            const Eigen::Vector2d& p_map) {
  std::vector<std::pair<double, int>> near;
  for (int i = 0; i < graph.size(); ++i) {
    const double distance = (graph.pose(i).p - p_map).norm();
    if (distance < options_.reach && !surfaces.is_hidden(graph.submap_of(i)))
      near.emplace_back(distance, i);
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min(near.size(), static_cast<std::size_t>(options_.max_keyframes)));
  matcher_->clear_reference();
  used_.clear();
  for (const auto& [distance, keyframe] : near) use(graph, keyframe);
  center_ = p_map;
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
