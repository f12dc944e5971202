// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_slam/scan_tracker.h"

#include <cmath>
#include <map>

#include "graph_slam/relocalizer.h"

namespace trident {
namespace {

/// Part of the points by which a place that was sought must fit better than the one at hand.
constexpr double kSearchGain = 0.05;

}  // namespace

const MaxPyramid& ScanTracker::hits_about(const Eigen::Vector2d& p_map) {
  constexpr double kMostAway = 3.0;  // [m]
  constexpr int kMostChanges = 5;
  const bool is_fresh =
      hits_ && (p_map - hits_centre_).norm() < kMostAway && changes_ - hits_changes_ < kMostChanges;
  if (is_fresh) return *hits_;
  hits_.emplace(options_.search_resolution, 4);
  insert_surfels(surfels_, p_map, options_.search_reach, &*hits_);
  hits_centre_ = p_map;
  hits_changes_ = changes_;
  return *hits_;
}

MatchResult ScanTracker::search(const PointScan& scan, const PosePrior& prior,
                                const MatchResult& refined, const SearchWindow& window) {
  const MaxPyramid& hits = hits_about(prior.T_ref_base.p);
  const auto found =
      match_by_branch_and_bound(hits, thinned_points(scan, 200), prior.T_ref_base, window, 0.2);
  if (!found) return refined;
  const MatchResult other = refine(scan, found->T_ref_base, prior);
  return other.inlier_fraction > refined.inlier_fraction + kSearchGain ? other : refined;
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
    match = refine(scan, prior.T_ref_base, prior);
    const bool is_far = metres > options_.search_motion || radians > options_.search_turn;
    const SE2 off = prior.T_ref_base.inverse() * match.T_ref_base;
    const bool is_odd = off.p.norm() > 3.0 * s_p || std::abs(off.angle) > 3.0 * s_yaw;
    const bool is_doubted = is_far || is_odd || doubt > 0.0 ||
                            match.inlier_fraction < options_.smallest_inlier_fraction;
    if (is_doubted && match.inlier_fraction + kSearchGain < 1.0) {
      match = search(scan, prior, match, {0.2 + 3.0 * s_p, 0.05 + 2.0 * s_yaw});
    }
  }
  T_map_base_ = match.T_ref_base;
  return match;
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
