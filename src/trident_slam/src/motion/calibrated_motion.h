// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "trident_base/se2.h"

namespace trident::slam {

/// What is wrong with odometry, and where the laser sits on the base. Order of CalibrationVector.
enum CalibrationParameter {
  kDistanceScale,  ///< true by reported distance
  kTurnScale,      ///< true by reported rotation
  kYawDrift,       ///< unreported rotation per reported meter ahead [rad/m]
  kLaserX,         ///< [m]
  kLaserY,         ///< [m]
  kLaserYaw,       ///< [rad]
};
constexpr int kCalibrationParameters = 6;
using CalibrationVector = Eigen::Matrix<double, kCalibrationParameters, 1>;
using CalibrationMatrix = Eigen::Matrix<double, kCalibrationParameters, kCalibrationParameters>;

/// How the laser moves if the parameters are right: odometry's increments one after the other, each
/// taken as a constant twist (v_x, v_y, w), become
///   v = distance_scale (v_x, v_y) + (c w, 0),  w = turn_scale w + yaw_drift v_x.
/// For a differential drive of the nominal wheel base b, c = yaw_drift b^2 distance_scale / (4
/// turn_scale), and the three numbers are those of Censi et al. 2013: two wheels' radii and the
/// true wheel base b distance_scale / turn_scale. Without a wheel base c = 0.
class CalibratedMotion {
 public:
  explicit CalibratedMotion(const CalibrationVector& parameters, double wheel_base = 0.0);

  /// Odometry's next increment.
  void add(const SE2& T_before_now);

  SE2 of_base() const { return T_first_base_; }
  SE2 of_laser() const;
  /// d/d(parameters) of `of_laser`, as tangents (vx, vy, w) at its end: T(p + d) = T(p) exp(J d).
  Eigen::Matrix<double, 3, kCalibrationParameters> laser_jacobian() const;

 private:
  SE2 T_base_laser() const;

  CalibrationVector parameters_;
  double wheel_base_;
  SE2 T_first_base_;
  Eigen::Matrix3d by_scales_ = Eigen::Matrix3d::Zero();  ///< of the base, by the first three
};

}  // namespace trident::slam
