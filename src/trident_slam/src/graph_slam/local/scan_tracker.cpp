// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_tracker.h"

#include <cmath>
#include <map>

#include "graph_slam/loop/relocalizer.h"

namespace trident::slam {
const MaxPyramid& ScanTracker::hits_about(const Eigen::Vector2d& p_map) {
  const bool is_fresh = hits_ && (p_map - hits_center_).norm() < options_.search.max_distance &&
                        changes_ - hits_changes_ < options_.search.max_changes;
  if (is_fresh) return *hits_;
  hits_.emplace(options_.search.resolution, options_.search.levels);
  insert_surfels(surfels_, p_map, options_.search.reach, &*hits_);
  hits_center_ = p_map;
  hits_changes_ = changes_;
  return *hits_;
}

PosePrior ScanTracker::Guess::prior() const {
  PosePrior prior;
  prior.is_independent = is_by_wheels;
  prior.T_ref_base = T_map_base;
  prior.information.diagonal() << 1.0 / (s_p * s_p), 1.0 / (s_p * s_p), 1.0 / (s_yaw * s_yaw);
  return prior;
}

double ScanTracker::Guess::squared_deviation(const SE2& T) const {
  const SE2 off = T_map_base.inverse() * T;
  return off.p.squaredNorm() / (s_p * s_p) + off.angle * off.angle / (s_yaw * s_yaw);
}

/// Odometry that stood still while the robot moved catches up in one step, which counts from where
/// it stood still.
SE2 ScanTracker::expected(const OdometryMotion::Step& step) {
  if (step.by_scans) {
    T_reported_base_ = SE2::identity();
    return T_map_base_ * step.T_before_now;
  }
  if (step.is_stale) return T_map_base_;
  const SE2 T_reported_map = T_reported_base_ * T_map_base_.inverse();
  T_reported_base_ = SE2::identity();
  return T_reported_map.inverse() * step.T_before_now;
}

void ScanTracker::coast(const OdometryMotion::Step& step) {
  const SE2 T_base_before = T_map_base_.inverse();
  T_map_base_ = expected(step);
  T_before_now_ = T_base_before * T_map_base_;
}

ScanTracker::Guess ScanTracker::guess(const OdometryMotion::Step& step) {
  const double meters = step.T_before_now.p.norm();
  const double radians = std::abs(step.T_before_now.angle);
  const bool has_problem = !step.problem.empty();
  const OdometryNoiseOptions& noise = options_.noise.other;
  Guess guess;
  guess.s_p =
      options_.noise.distance_sigma(meters, radians) + (has_problem ? noise.problem_distance : 0.0);
  guess.s_yaw = options_.noise.yaw_sigma(meters, radians) + (has_problem ? noise.problem_yaw : 0.0);
  if (step.is_stale) {  // it may continue as before
    guess.s_p += T_before_now_.p.norm();
    guess.s_yaw += std::abs(T_before_now_.angle);
  }
  if (step.by_scans) {
    guess.s_p = step.by_scans->s_p;
    guess.s_yaw = step.by_scans->s_yaw;
  }
  guess.is_by_wheels = !step.by_scans && step.problem.empty();
  guess.T_map_base = expected(step);
  return guess;
}

MatchResult ScanTracker::match(const PointScan& scan, const Guess& guess, bool is_firm) const {
  PosePrior prior = guess.prior();
  prior.is_firm = is_firm;
  return refine(scan, guess.T_map_base, prior);
}

MatchResult ScanTracker::search(const PointScan& scan, const Guess& guess,
                                const SearchWindow& window) {
  const MaxPyramid& hits = hits_about(guess.T_map_base.p);
  const auto max_points = static_cast<std::size_t>(options_.search.max_points);
  const auto found =
      match_by_branch_and_bound(hits, thinned_points(scan, max_points), guess.T_map_base, window,
                                options_.search.min_response);
  if (!found) return {};
  return refine(scan, found->T_ref_base, guess.prior());
}

MatchResult ScanTracker::better(const MatchResult& a, const MatchResult& b,
                                const Guess& guess) const {
  const TrackingOptions& tracking = options_.tracking;
  const auto score = [&](const MatchResult& match) {
    const double deviation = guess.squared_deviation(match.T_ref_base);
    return match.inlier_fraction -
           tracking.prior_weight * deviation / (deviation + tracking.max_squared_deviation);
  };
  return score(a) > score(b) + tracking.search_gain ? a : b;
}

bool ScanTracker::is_off_prior(const MatchResult& match, const Guess& guess) const {
  const SE2 off = guess.T_map_base.inverse() * match.T_ref_base;
  return off.p.norm() > options_.tracking.prior_sigmas * guess.s_p ||
         std::abs(off.angle) > options_.tracking.prior_sigmas * guess.s_yaw;
}

// A long motion may have left the reach of the match, and poor odometry its start.
bool ScanTracker::is_uncertain(const OdometryMotion::Step& step, const MatchResult& match) const {
  const TrackingOptions& tracking = options_.tracking;
  const bool is_far = step.T_before_now.p.norm() > tracking.search_motion ||
                      std::abs(step.T_before_now.angle) > tracking.search_turn;
  const double enough = step.by_scans ? tracking.min_inliers_by_scans : tracking.min_inliers;
  return is_far || !step.problem.empty() || match.inlier_fraction < enough;
}

SearchWindow ScanTracker::near_window(const Guess& guess) const {
  const TrackingSearchOptions& search = options_.search;
  return {search.near_window + search.window_sigmas * guess.s_p,
          search.near_window_yaw + search.window_sigmas_yaw * guess.s_yaw};
}

MatchResult ScanTracker::search_near(const PointScan& scan, const Guess& guess,
                                     const MatchResult& best) {
  MatchResult result = best;
  if (is_off_prior(best, guess)) result = better(best, match(scan, guess, true), guess);
  return better(search(scan, guess, near_window(guess)), result, guess);
}

// Where hardly anything fits the robot may be lost; where something fits, but odometry excludes the
// pose, the match may be at a similar place. The latter needs more to be replaced.
MatchResult ScanTracker::search_wide(const PointScan& scan, const Guess& guess,
                                     const MatchResult& best) {
  const TrackingOptions& tracking = options_.tracking;
  const bool is_lost = best.inlier_fraction < tracking.lost_inliers;
  const bool is_inconsistent =
      best.inlier_fraction < tracking.inconsistent_inliers &&
      guess.squared_deviation(best.T_ref_base) > tracking.max_squared_deviation;
  if (!is_lost && !is_inconsistent) return best;
  const SearchWindow near = near_window(guess);
  const SearchWindow wide{near.linear + options_.search.wide_window,
                          near.angular + options_.search.wide_window_yaw};
  const MatchResult other = search(scan, guess, wide);
  const double enough = is_lost ? tracking.min_lost_inliers : tracking.min_inconsistent_inliers;
  return other.inlier_fraction > enough ? better(other, best, guess) : best;
}

MatchResult ScanTracker::track(const PointScan& scan, const OdometryMotion::Step& step) {
  // 1. Predict: the pose by odometry, or by the scans' own motion.
  const Guess guess = this->guess(step);
  const SE2 T_base_before = T_map_base_.inverse();
  MatchResult best;
  best.T_ref_base = guess.T_map_base;
  if (!surfels_.empty()) {
    // 2. Match: with the surfaces, from the prediction.
    best = match(scan, guess, false);
    // 3. Search near: where the match is uncertain and another pose could fit better.
    const bool is_improvable = best.inlier_fraction + options_.tracking.search_gain < 1.0;
    if (is_improvable && (is_off_prior(best, guess) || is_uncertain(step, best))) {
      best = search_near(scan, guess, best);
    }
    // 4. Search wide: where the scan fits nowhere near, or odometry excludes the pose.
    best = search_wide(scan, guess, best);
  }
  // 5. Update: the pose and the motion up to it.
  T_map_base_ = best.T_ref_base;
  T_before_now_ = T_base_before * T_map_base_;
  if (step.is_stale) T_reported_base_ = T_reported_base_ * T_before_now_;
  return best;
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

}  // namespace trident::slam
