// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "grids/probability_grid.h"
#include "trident_base/se2.h"
#include "trident_slam/point_scan.h"

namespace trident::slam {

/// The sums of one Gauss-Newton step for sum (1 - M(p))^2 over the points p of a scan.
struct MapMatchSums {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();  ///< J' J by (x [m], y [m], yaw [rad])
  Eigen::Vector3d g = Eigen::Vector3d::Zero();  ///< J' (1 - M), J = dM / d(x, y, yaw)
  double cost = 0.0;
};
MapMatchSums map_match_sums(const ProbabilityGrid& map, const PointScan& scan,
                            const SE2& T_map_base);

struct MapMatch {
  SE2 T_map_base;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< of (x [m], y [m], yaw [rad])
};

/// From `guess`, `iterations` steps. Directions without information from the points keep the guess.
MapMatch match_map(const ProbabilityGrid& map, const PointScan& scan, const SE2& guess,
                   int iterations);

}  // namespace trident::slam
