// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "recent_scans.h"

namespace trident::slam {

double RecentScans::refine(const PointScan& scan, MatchResult* match) const {
  if (scans_.empty()) return 0.0;
  PosePrior prior;
  prior.T_ref_base = match->T_ref_base;
  const Eigen::Matrix3d information = match->covariance.inverse();
  prior.information = 0.5 * (information + information.transpose());
  const MatchResult refined = match_lines(surfels_, scan, match->T_ref_base, prior, line_);
  match->T_ref_base = refined.T_ref_base;
  match->covariance = refined.covariance;
  return refined.inlier_fraction;
}

void RecentScans::add(const SE2& T_map_base, const std::shared_ptr<const PointScan>& scan) {
  if (size_ == 0) return;
  scans_.push_back({T_map_base, scan});
  while (scans_.size() > size_ || (scans_.front().T_map_base.p - T_map_base.p).norm() > reach_) {
    scans_.pop_front();
  }
  surfels_.clear();
  for (const Placed& placed : scans_) surfels_.insert(placed.T_map_base, *placed.scan);
}

void RecentScans::clear() {
  scans_.clear();
  surfels_.clear();
}

}  // namespace trident::slam
