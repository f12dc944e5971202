// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "grids/probability_grid.h"
#include "trident_base/se2.h"
#include "trident_slam/point_scan.h"

namespace trident::slam {

/// A Gaussian over poses; covariance of (x [m], y [m], yaw [rad]) in the map's frame.
struct PoseGaussian {
  SE2 T_map_base;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

/// Where a pose comes to lie, by odometry and the scan together.
struct Proposal {
  PoseGaussian pose;
  /// ln of the scan's likelihood given map and odometry, up to a constant that all particles share.
  double log_evidence = 0.0;
  double score = 0.0;  ///< mean probability under the scan's points
};

/// Minimum of sum (1 - M(p))^2 / (2 sigma^2) + half the squared Mahalanobis distance to `motion`,
/// by Gauss-Newton, with its curvature: the Laplace approximation of p(scan, pose | map, odometry).
/// `beam_weight`: how much one point counts, since neighbors are not
/// independent.
Proposal propose(const ProbabilityGrid& map, const PointScan& scan, const PoseGaussian& motion,
                 double beam_weight);

}  // namespace trident::slam
