// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "trident_base/se2.h"

namespace trident::slam {

/// How well a scan constrains its pose: the eigenvalues of the information that its points give,
/// with yaw counted in meters at the mean distance of the points. J. Zhang, M. Kaess, S. Singh, "On
/// degeneracy of optimization-based state estimation problems", ICRA 2016.
struct Degeneracy {
  /// Smallest by largest eigenvalue: 1 in a round room, towards 0 in a long corridor.
  double ratio = 0.0;
  /// The direction that is known least: (x, y, yaw at the points' mean distance), unit length.
  Eigen::Vector3d weakest = Eigen::Vector3d::UnitX();

  static constexpr double kDegenerateRatio = 0.02;  ///< below it a direction counts as open
  /// Whether `weakest` must come from elsewhere.
  bool is_degenerate() const { return ratio < kDegenerateRatio; }
};

/// What is known of a pose beforehand.
struct PosePrior {
  SE2 T_ref_base;                                         ///< mean
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of (x, y, yaw) in the ref's frame
  bool is_firm = false;  ///< not doubted, however far the points lead away from it
  /// Measured by something other than scans (wheels): along directions that the points leave open
  /// it alone counts.
  bool is_independent = false;
};

/// Where a scan lies in a reference's frame.
struct MatchResult {
  SE2 T_ref_base;  ///< of the base at the scan's stamp
  /// Of (x [m], y [m], yaw [rad]) in the reference's frame, from the points alone.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// Inverse of the information with whatever prior was given.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  Degeneracy degeneracy;         ///< of `information`
  double inlier_fraction = 0.0;  ///< of the points, those that lie on the reference's surfaces
  double rms = 0.0;              ///< of those points' distances to the surfaces [m]
  int iterations = 0;            ///< Gauss-Newton steps
  bool is_converged = false;     ///< the last step was small; else the steps ran out
};

/// `mean_range`: of the points about the base [m].
Degeneracy degeneracy_of(const Eigen::Matrix3d& information, double mean_range);

}  // namespace trident::slam
