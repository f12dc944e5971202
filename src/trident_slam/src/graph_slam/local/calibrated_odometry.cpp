// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "calibrated_odometry.h"

#include <Eigen/LU>

namespace trident::slam {
namespace {

/// Of the laser as a tangent at its pose, from the points alone.
Eigen::Matrix3d covariance_of_laser(const MatchResult& match, const SE2& T_base_laser,
                                    const CalibrationOptions& options) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = match.T_ref_base.rotation().transpose();
  const Eigen::Matrix3d A = T_base_laser.inverse().adjoint() * R;
  Eigen::Matrix3d covariance = A * match.information.inverse() * A.transpose();
  covariance.diagonal() +=
      Eigen::Vector3d(options.min_sigma, options.min_sigma, options.min_sigma_yaw).cwiseAbs2();
  return covariance;
}

}  // namespace

void CalibratedOdometry::learn(const SE2& T_base_laser, const SE2& T_last_base_seen,
                               const MatchResult& match) {
  const bool is_other_laser =
      T_base_laser_.p != T_base_laser.p || T_base_laser_.angle != T_base_laser.angle;
  if (!calibration_ || is_other_laser) calibration_.emplace(T_base_laser);
  T_base_laser_ = T_base_laser;
  if (match.inlier_fraction < options_.min_inliers || match.degeneracy.is_degenerate()) {
    calibration_->interrupt();
    return;
  }
  calibration_->add(T_last_base_, T_base_laser.inverse() * T_last_base_seen * T_base_laser,
                    covariance_of_laser(match, T_base_laser, options_));
}

double CalibratedOdometry::noise_fraction() const {
  const bool is_corrected = is_applied_ && calibration_ &&
                            calibration_->is_observed(kDistanceScale) &&
                            calibration_->is_observed(kYawDrift);
  return is_corrected ? options_.corrected_fraction : 1.0;
}

std::vector<CalibrationEstimate> CalibratedOdometry::estimates() const {
  std::vector<CalibrationEstimate> estimates;
  if (!calibration_) return estimates;
  for (int i = 0; i < kCalibrationParameters; ++i) {
    const auto parameter = static_cast<CalibrationParameter>(i);
    estimates.push_back({kCalibrationNames[static_cast<std::size_t>(i)],
                         calibration_->parameters()[i], calibration_->sigma(parameter),
                         calibration_->is_observed(parameter)});
  }
  return estimates;
}

}  // namespace trident::slam
