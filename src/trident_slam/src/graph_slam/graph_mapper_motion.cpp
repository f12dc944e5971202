// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What a scan is told of the motion up to it, and what it says of that once it is placed.
#include "graph_mapper.h"
#include "matchers/surface_information.h"
#include "trident_slam/sweep_motion.h"

namespace trident::slam {

Eigen::Vector3d GraphMapper::twist_of(const LaserScan& scan, const SE2& T_last_base) const {
  if (!options_.deskew) return Eigen::Vector3d::Zero();
  return sweep_twist(scan, T_last_base, 1e-9 * static_cast<double>(scan.stamp_ns - last_stamp_ns_));
}

PointScan GraphMapper::points_of(const LaserScan& scan, const Eigen::Vector3d& twist) const {
  return make_point_scan(scan, {options_.min_laser_range, options_.max_laser_range}, twist);
}

void GraphMapper::tell_uncertainty(const OdometryMotion::Step& motion, const MatchResult& match,
                                   const PointScan& points, ScanPose2d* result) {
  result->motion_by = motion_source_.motion_by();
  result->covariance = match.covariance;
  if (tracker_.surfels().empty()) return;  // here the map begins
  if (motion.by_scans && options_.use_scan_matching) {
    uncertainty_.add(motion_source_.scan_step(), match, mean_range(points));
    result->is_open = uncertainty_.is_open();
  } else {
    uncertainty_.set(match.covariance);
  }
  result->covariance = uncertainty_.covariance();
}

std::string GraphMapper::settle_motion(const OdometryMotion::Step& motion, bool is_shown) {
  const SE2& T_before_now = tracker_.T_before_now();
  if (motion.by_scans) travelled_ += T_before_now.p.norm();
  return motion_source_.settle(T_before_now, is_shown);
}

}  // namespace trident::slam
