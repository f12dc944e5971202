// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "motion/scan_odometry.h"
#include "trident_slam/match_result.h"

namespace trident::slam {

/// The covariance of a pose whose motion is measured by scans alone. Where the surroundings leave a
/// direction open, every step along it adds its own uncertainty, until a place is seen that does
/// not.
class PoseUncertainty {
 public:
  /// A scan at `match`, after a step as measured by scans.
  void add(const ScanStep& step, const MatchResult& match, double mean_range);
  /// The motion comes from odometry, and the covariance is that of the match.
  void set(const Eigen::Matrix3d& covariance) { covariance_ = covariance; }

  /// Of (x [m], y [m], yaw [rad]) in the map.
  const Eigen::Matrix3d& covariance() const { return covariance_; }
  bool is_open() const { return is_open_; }

 private:
  Eigen::Matrix3d covariance_ = 1e-6 * Eigen::Matrix3d::Identity();
  bool is_open_ = false;
};

}  // namespace trident::slam
