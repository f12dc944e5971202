// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_deskewer.h"

#include "trident_slam/sweep_motion.h"

namespace trident::slam {

ScanDeskewer::ScanDeskewer(const GraphSlamOptions& options)
    : is_enabled_(options.deskew),
      options_(options.front_end.deskewing),
      ranges_{options.min_laser_range, options.max_laser_range} {}

Eigen::Vector3d ScanDeskewer::predict_twist(const LaserScan& scan, const SE2& T_last_base) const {
  if (!is_enabled_) return Eigen::Vector3d::Zero();
  return sweep_twist(scan, T_last_base, 1e-9 * static_cast<double>(scan.stamp_ns - last_stamp_ns_));
}

Eigen::Vector3d ScanDeskewer::correct_twist(const PendingScan& pending, std::int64_t next_stamp_ns,
                                            const OdometryMotion::Step& motion) const {
  const double passed = 1e-9 * static_cast<double>(next_stamp_ns - pending.scan.stamp_ns);
  const bool is_known = motion.problem.empty() && passed > 0.0 && passed <= options_.max_gap;
  return is_known ? sweep_twist(pending.scan, motion.T_before_now, passed) : pending.twist;
}

PointScan ScanDeskewer::points(const LaserScan& scan, const Eigen::Vector3d& twist) const {
  return make_point_scan(scan, ranges_, twist);
}

bool ScanDeskewer::is_match_outdated(const PendingScan& pending,
                                     const Eigen::Vector3d& twist) const {
  const double sweep = sweep_duration(pending.scan);
  const Eigen::Vector3d error = (twist - pending.twist) * sweep;
  return error.cwiseAbs().maxCoeff() > options_.max_error;
}

PosePrior ScanDeskewer::corrected_prior(const PendingScan& pending, const Eigen::Vector3d& twist,
                                        const SE2& T_map_base) const {
  const double sweep = sweep_duration(pending.scan);
  PosePrior prior;
  prior.T_ref_base = T_map_base * SE2::exp(pending.twist * (0.5 * sweep)) *
                     SE2::exp(twist * (0.5 * sweep)).inverse();
  prior.information.diagonal().setConstant(options_.information);
  return prior;
}

}  // namespace trident::slam
