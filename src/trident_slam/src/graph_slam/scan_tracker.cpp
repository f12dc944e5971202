// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_slam/scan_tracker.h"

#include <cmath>
#include <map>

namespace trident {

void ScanTracker::clear_surfaces() {
  surfels_ = SurfelMap(options_.surfel_cell);
  recent_.clear();
}

MatchResult ScanTracker::search(const PointScan& scan, const PosePrior& prior,
                                const MatchResult& refined, const SearchWindow& window) const {
  MaxPyramid hits(options_.search_resolution, 4);
  for (const auto& [T, old_scan] : recent_) hits.insert(T, *old_scan);
  const auto found =
      match_by_branch_and_bound(hits, thinned_points(scan, 200), prior.T_ref_base, window, 0.2);
  if (!found) return refined;
  const MatchResult other = match_lines(surfels_, scan, found->T_ref_base, prior, options_.line);
  return other.inlier_fraction > refined.inlier_fraction + 0.05 ? other : refined;
}

MatchResult ScanTracker::track(const PointScan& scan, const SE2& T_last_base, double doubt) {
  const double metres = T_last_base.p.norm();
  const double radians = std::abs(T_last_base.angle);
  PosePrior prior;
  prior.T_ref_base = T_map_base_ * T_last_base;
  const double s_p = options_.noise.distance_sigma(metres, radians) + doubt;
  const double s_yaw = options_.noise.yaw_sigma(metres, radians) + 0.5 * doubt;
  prior.information.diagonal() << 1.0 / (s_p * s_p), 1.0 / (s_p * s_p), 1.0 / (s_yaw * s_yaw);
  MatchResult match;
  match.T_ref_base = prior.T_ref_base;
  if (!surfels_.empty()) {
    match = match_lines(surfels_, scan, prior.T_ref_base, prior, options_.line);
    const bool is_far = metres > options_.search_motion || radians > options_.search_turn;
    if (is_far || doubt > 0.0 || match.inlier_fraction < options_.smallest_inlier_fraction) {
      match = search(scan, prior, match, {0.1 + 2.0 * s_p, 0.05 + 2.0 * s_yaw});
    }
  }
  T_map_base_ = match.T_ref_base;
  return match;
}

void ScanTracker::insert(const SE2& T_map_base, const std::shared_ptr<const PointScan>& scan,
                         int owner) {
  surfels_.insert(T_map_base, *scan, owner);
  if (static_cast<int>(recent_.size()) >= options_.recent_scans) recent_.erase(recent_.begin());
  recent_.emplace_back(T_map_base, scan);
}

std::vector<std::pair<int, int>> ScanTracker::owners_under(const PointScan& scan) const {
  std::map<int, int> counts;
  const Eigen::Matrix2f R = T_map_base_.rotation().cast<float>();
  const Eigen::Vector2f t = T_map_base_.p.cast<float>();
  for (const SurfacePoint& point : scan.points) {
    const Surfel* surfel = surfels_.nearest(R * point.p + t, R * point.normal, 1);
    if (surfel != nullptr) ++counts[surfel->owner];
  }
  return {counts.begin(), counts.end()};
}

}  // namespace trident
