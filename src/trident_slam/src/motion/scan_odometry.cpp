// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_odometry.h"

#include <optional>
#include <utility>

#include "matchers/correlative_match.h"
#include "motion_filter.h"

namespace trident::slam {
namespace {

/// The scans that a new one is matched with.
constexpr std::size_t kKept = 12;
const MotionFilter kKeptApart({0.1, 0.1});
/// Part of the points that must lie on surfaces, else the pose is searched for in the first
/// window, and in the second one; one that was found so must fit better by the gain.
constexpr double kGoodFit = 0.8;
constexpr double kPoorFit = 0.6;
constexpr double kSearchGain = 0.05;
constexpr SearchWindow kNear{0.4, 0.4};
constexpr SearchWindow kWide{1.0, 0.9};
constexpr double kSearchResolution = 0.05;  // [m]
constexpr std::size_t kSearchPoints = 200;
constexpr double kMinResponse = 0.2;
/// Less is no match.
constexpr double kMinFit = 0.4;
/// What a match errs by, whatever its points say [m], [rad].
constexpr double kMinSigma = 0.01;
constexpr double kMinYawSigma = 0.005;
constexpr double kLostSigma = 0.3;

/// Consecutive scans err alike less than a scan and a map, and returns without a normal (the far
/// end of a corridor) give most of the information along it.
LineMatchOptions line_options() {
  LineMatchOptions options;
  options.sigma = 0.02;
  options.point_weight = 0.3;
  return options;
}

Eigen::Matrix3d squared(const Eigen::Vector3d& sigma) { return sigma.cwiseAbs2().asDiagonal(); }

PosePrior prior_of(const SE2& T_local_last, const ExpectedMotion& expected) {
  const double p = expected.spread.s_p;
  const double yaw = expected.spread.s_yaw;
  PosePrior prior;
  prior.T_ref_base = T_local_last * expected.T_before_now;
  prior.information.diagonal() << 1.0 / (p * p), 1.0 / (p * p), 1.0 / (yaw * yaw);
  return prior;
}

}  // namespace

void ScanOdometry::keep(const std::shared_ptr<const PointScan>& scan) {
  recent_.push_back({T_local_base_, scan});
  T_kept_base_ = SE2::identity();
  is_newest_kept_ = true;
  if (recent_.size() <= kKept) {
    surfels_.insert(T_local_base_, *scan);
    return;
  }
  recent_.pop_front();
  surfels_.clear();
  for (const Placed& placed : recent_) surfels_.insert(placed.T_local_base, *placed.scan);
}

MaxPyramid ScanOdometry::recent_hits() const {
  MaxPyramid hits(kSearchResolution, 5);
  for (const Placed& placed : recent_) hits.insert(placed.T_local_base, *placed.scan);
  return hits;
}

MatchResult ScanOdometry::match(const PointScan& scan, const ExpectedMotion& expected) const {
  const PosePrior prior = prior_of(T_local_base_, expected);
  const LineMatchOptions line = line_options();
  MatchResult best = match_lines(surfels_, scan, prior.T_ref_base, prior, line);
  std::optional<MaxPyramid> hits;
  for (const auto& [enough, window] : {std::pair(kGoodFit, kNear), std::pair(kPoorFit, kWide)}) {
    if (best.inlier_fraction >= enough) break;
    if (!hits) hits = recent_hits();
    const auto found = match_by_branch_and_bound(*hits, thinned_points(scan, kSearchPoints),
                                                 prior.T_ref_base, window, kMinResponse);
    if (!found) continue;
    const MatchResult other = match_lines(surfels_, scan, found->T_ref_base, prior, line);
    if (other.inlier_fraction > best.inlier_fraction + kSearchGain) best = other;
  }
  return best;
}

ScanStep ScanOdometry::track(const std::shared_ptr<const PointScan>& scan,
                             const ExpectedMotion& expected) {
  ScanStep step;
  const SE2 T_kept_before = T_kept_base_;
  if (recent_.empty()) {
    keep(scan);
    return step;
  }
  const MatchResult best = match(*scan, expected);
  step.is_sure = best.inlier_fraction >= kMinFit;
  step.is_open = step.is_sure && best.degeneracy.is_degenerate();
  const SE2 T_local_base = step.is_sure ? best.T_ref_base : T_local_base_ * expected.T_before_now;
  const SE2 T_kept_now = recent_.back().T_local_base.inverse() * T_local_base;
  step.T_before_now = T_kept_before.inverse() * T_kept_now;
  step.covariance = squared({kMinSigma, kMinSigma, kMinYawSigma});
  if (step.is_sure) {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    R.topLeftCorner<2, 2>() = T_local_base_.rotation().transpose();
    step.covariance += R * best.covariance * R.transpose();
  } else {
    step.covariance += squared({kLostSigma, kLostSigma, kLostSigma});
  }
  T_local_base_ = T_local_base;
  is_newest_kept_ = false;
  if (kKeptApart.is_due(T_kept_now)) keep(scan);
  return step;
}

void ScanOdometry::coast(const SE2& T_before_now) {
  T_local_base_ = T_local_base_ * T_before_now;
  is_newest_kept_ = false;
}

void ScanOdometry::settle(const SE2& T_before_now) {
  if (!is_newest_kept_) T_kept_base_ = T_kept_base_ * T_before_now;
}

}  // namespace trident::slam
