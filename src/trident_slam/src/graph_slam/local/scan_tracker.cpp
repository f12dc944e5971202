// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_tracker.h"

#include <cmath>
#include <map>

#include "graph_slam/loop/relocalizer.h"

namespace trident::slam {
namespace {

/// What odometry that cannot be believed adds to its standard deviation [m], half of it [rad].
constexpr double kDoubt = 0.5;
/// Part of the points by which a place that was sought must fit better than the one at hand.
constexpr double kSearchGain = 0.05;
/// A place that odometry excludes must fit better by this part of the points; half of it at
/// kDoubtedDeviation [squared standard deviations].
constexpr double kWorthOfGuess = 0.35;
constexpr double kDoubtedDeviation = 9.0;
/// Part of the points that must fit in a place that a wide search finds where hardly any place
/// fitted, ...
constexpr double kSureFraction = 0.7;
/// ... and where the one at hand fits somewhat, but not odometry.
constexpr double kCertainFraction = 0.95;
/// Part of the points below which a place fits somewhat only.
constexpr double kFitsSomewhat = 0.8;

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
    T_told_base_ = SE2::identity();
    return T_map_base_ * step.T_before_now;
  }
  if (step.is_stale) return T_map_base_;
  const SE2 T_told_map = T_told_base_ * T_map_base_.inverse();
  T_told_base_ = SE2::identity();
  return T_told_map.inverse() * step.T_before_now;
}

void ScanTracker::coast(const OdometryMotion::Step& step) {
  const SE2 T_base_before = T_map_base_.inverse();
  T_map_base_ = expected(step);
  T_before_now_ = T_base_before * T_map_base_;
}

ScanTracker::Guess ScanTracker::guess(const OdometryMotion::Step& step) {
  const double metres = step.T_before_now.p.norm();
  const double radians = std::abs(step.T_before_now.angle);
  const double doubt = step.problem.empty() ? 0.0 : kDoubt;
  Guess guess;
  guess.s_p = options_.noise.distance_sigma(metres, radians) + doubt;
  guess.s_yaw = options_.noise.yaw_sigma(metres, radians) + 0.5 * doubt;
  if (step.is_stale) {  // it may go on as before
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
  const auto found =
      match_by_branch_and_bound(hits, thinned_points(scan, 200), guess.T_map_base, window, 0.2);
  if (!found) return {};
  return refine(scan, found->T_ref_base, guess.prior());
}

MatchResult ScanTracker::better(const MatchResult& a, const MatchResult& b, const Guess& guess) {
  const auto score = [&guess](const MatchResult& match) {
    const double deviation = guess.squared_deviation(match.T_ref_base);
    return match.inlier_fraction - kWorthOfGuess * deviation / (deviation + kDoubtedDeviation);
  };
  return score(a) > score(b) + kSearchGain ? a : b;
}

MatchResult ScanTracker::track(const PointScan& scan, const OdometryMotion::Step& step) {
  const Guess guess = this->guess(step);
  const SE2 T_base_before = T_map_base_.inverse();
  MatchResult best;
  best.T_ref_base = guess.T_map_base;
  if (!surfels_.empty()) {
    best = match(scan, guess, false);
    const bool is_far = step.T_before_now.p.norm() > options_.search_motion ||
                        std::abs(step.T_before_now.angle) > options_.search_turn;
    const SE2 off = guess.T_map_base.inverse() * best.T_ref_base;
    const bool is_odd = off.p.norm() > 3.0 * guess.s_p || std::abs(off.angle) > 3.0 * guess.s_yaw;
    const double enough =
        step.by_scans ? options_.inlier_fraction_by_scans : options_.smallest_inlier_fraction;
    const bool is_doubted =
        is_far || is_odd || !step.problem.empty() || best.inlier_fraction < enough;
    const SearchWindow near{0.2 + 3.0 * guess.s_p, 0.05 + 2.0 * guess.s_yaw};
    const SearchWindow wide{near.linear + 1.0, near.angular + 0.8};
    if (is_doubted && best.inlier_fraction + kSearchGain < 1.0) {
      if (is_odd) best = better(best, match(scan, guess, true), guess);
      best = better(search(scan, guess, near), best, guess);
    }
    const bool is_lost = best.inlier_fraction < options_.lost_inlier_fraction;
    const bool is_astray = best.inlier_fraction < kFitsSomewhat &&
                           guess.squared_deviation(best.T_ref_base) > kDoubtedDeviation;
    if (is_lost || is_astray) {
      const MatchResult other = search(scan, guess, wide);
      const double enough = is_lost ? kSureFraction : kCertainFraction;
      if (other.inlier_fraction > enough) best = better(other, best, guess);
    }
  }
  T_map_base_ = best.T_ref_base;
  T_before_now_ = T_base_before * T_map_base_;
  if (step.is_stale) T_told_base_ = T_told_base_ * T_before_now_;
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
