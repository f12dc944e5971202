// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/scan_matcher.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "surface_information.h"
#include "trident_base/angle.h"
#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

/// Of a pose that nothing is known of [m], [rad].
const Eigen::Vector3d kUnknown(1e3, 1e3, kPi);

bool is_finite(const SE2& T) { return T.p.allFinite() && std::isfinite(T.angle); }

bool is_finite(const PosePrior& prior) {
  return is_finite(prior.T_ref_base) && prior.information.allFinite();
}

std::size_t count_not_finite(const PointScan& scan) {
  return static_cast<std::size_t>(std::count_if(
      scan.points.begin(), scan.points.end(),
      [](const SurfacePoint& point) { return !point.p.allFinite() || !point.normal.allFinite(); }));
}

PointScan finite_part(const PointScan& scan) {
  PointScan finite;
  finite.origin = scan.origin;
  for (const SurfacePoint& point : scan.points) {
    if (point.p.allFinite() && point.normal.allFinite()) finite.points.push_back(point);
  }
  return finite;
}

Eigen::Matrix3d covariance_of(const PosePrior& prior) {
  const Eigen::Matrix3d unknown = kUnknown.cwiseAbs2().cwiseInverse().asDiagonal();
  if (!prior.information.allFinite()) return unknown.inverse();
  return (prior.information + unknown).inverse();
}

std::string fault_of(const ScanMatch& match) {
  if (!is_finite(match.T_ref_base) || !match.covariance.allFinite()) {
    return "the match did not stay finite";
  }
  if (!match.problem.empty()) return match.problem;
  return match.inlier_fraction == 0.0 ? "no point lies on a surface of the reference" : "";
}

}  // namespace

void ScanMatcher::set_reference(const std::vector<PlacedPoints>& scans) {
  clear_reference();
  for (const PlacedPoints& placed : scans) add_to_reference(placed.T_ref_base, placed.scan);
}

void ScanMatcher::add_to_reference(const SE2& T_ref_base, const PointScan& scan) {
  if (!is_finite(T_ref_base)) return;
  if (count_not_finite(scan) > 0) {
    add_to_reference(T_ref_base, finite_part(scan));
    return;
  }
  if (scan.points.empty()) return;
  add(T_ref_base, scan);
  has_reference_ = true;
}

void ScanMatcher::clear_reference() {
  clear();
  has_reference_ = false;
}

std::string ScanMatcher::problem_of(const PointScan& scan, const SE2& guess,
                                    const PosePrior& prior) const {
  if (!is_finite(guess)) return "the guess is not finite";
  if (!is_finite(prior)) return "the prior is not finite";
  const std::size_t bad = count_not_finite(scan);
  if (bad > 0) {
    return std::to_string(bad) + " of " + std::to_string(scan.points.size()) +
           " points are not finite";
  }
  if (scan.points.size() < kMinPoints) {
    return std::to_string(scan.points.size()) + " points, legal: at least " +
           std::to_string(kMinPoints);
  }
  return has_reference_ ? "" : "the reference has no points";
}

ScanMatch ScanMatcher::match(const PointScan& scan, const SE2& guess,
                             const PosePrior& prior) const {
  ScanMatch none;
  none.T_ref_base = guess;
  none.covariance = covariance_of(prior);
  none.problem = problem_of(scan, guess, prior);
  if (!none.problem.empty()) return none;
  ScanMatch match = find(scan, guess, prior);
  none.problem = fault_of(match);
  if (!none.problem.empty()) return none;
  if (match.degeneracy.is_degenerate() && prior.information.isZero(0.0)) {
    match.T_ref_base =
        held_where_degenerate(match.T_ref_base, guess, match.information, mean_range(scan));
  }
  return match;
}

std::unique_ptr<ScanMatcher> make_scan_matcher(const std::string& name,
                                               const ScanMatcherOptions& options) {
  Registry<ScanMatcherFactory> registry("scan matcher");
  register_builtin_scan_matchers(registry);
  return registry.get(name)(options);
}

}  // namespace trident::slam
