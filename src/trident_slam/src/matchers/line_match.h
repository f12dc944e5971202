// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "grids/surfel_map.h"
#include "trident_slam/match_result.h"

namespace trident::slam {

/// Point-to-line registration: Gauss-Newton over nearest surfels, each scan point's distance along
/// the surfel's normal, weighted by a Cauchy kernel.
/// A. Censi, "An ICP variant using a point-to-line metric", ICRA 2008.
struct LineMatchOptions {
  int max_iterations = 12;
  double converged = 5e-4;        ///< a step that moves the points by less is the last one [m]
  double settled = 0.01;          ///< points that moved less keep their surfels [m] ...
  double converged_pairs = 5e-4;  ///< ... and at the end, less than this [m]
  double least_paired = 0.0;     ///< part of the points that must have a surfel, else it ends early
  int search_rings = 3;          ///< cells about a point in which its surfel is searched for
  double sigma = 0.03;           ///< of one distance; correlated errors counted in [m]
  double kernel = 0.06;          ///< distance at which a point's weight has halved [m]
  double inlier_distance = 0.1;  ///< [m]
  /// Points farther than this along the line from the surfel's mean are beyond what the reference
  /// saw, where noise decides which of them match its end: no pair [m].
  double reach_along = 0.1;
  double point_weight = 0.1;     ///< of a point without a normal, towards the surfel's mean
  std::size_t max_points = 200;  ///< of a scan that are used, evenly spread
};

/// The sums of one Gauss-Newton step. With r the distances, c the kernel: the gradient of `cost` is
/// (sigma / c)^2 g, and H is its curvature at r = 0 in the same measure.
struct NormalEquations {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  double cost = 0.0;
  double squared_inliers = 0.0;
  std::size_t inliers = 0;
  std::size_t used = 0;
};

NormalEquations line_match_sums(const SurfelMap& reference, const PointScan& scan,
                                const SE2& T_ref_base, const LineMatchOptions& options);

MatchResult match_lines(const SurfelMap& reference, const PointScan& scan, const SE2& guess,
                        const PosePrior& prior, const LineMatchOptions& options);

}  // namespace trident::slam
