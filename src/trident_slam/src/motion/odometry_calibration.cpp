// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "odometry_calibration.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace trident::slam {
namespace {

/// A parameter is known from the motions alone if they leave less of its first variance than this,
/// with a belief beforehand of so small a part of the information that was there.
constexpr double kObservedVariance = 0.25;
constexpr double kWeakBelief = 0.01;

CalibrationVector as_vector(const std::array<double, kCalibrationParameters>& values) {
  return Eigen::Map<const CalibrationVector>(values.data());
}

CalibrationVector start(const SE2& T_base_laser) {
  CalibrationVector parameters;
  parameters << 1.0, 1.0, 0.0, T_base_laser.p, T_base_laser.angle;
  return parameters;
}

}  // namespace

OdometryCalibration::OdometryCalibration(const SE2& T_base_laser,
                                         const OdometryCalibrationOptions& options)
    : options_(options),
      T_base_laser_nominal_(T_base_laser),
      parameters_(start(T_base_laser)),
      covariance_(as_vector(options.sigma).cwiseAbs2().asDiagonal()),
      information_(CalibrationMatrix::Zero()),
      window_(CalibratedMotion(parameters_, options.wheel_base)) {}

void OdometryCalibration::start_window() {
  const Eigen::Matrix3d last = window_.last_covariance;
  window_ = Window(CalibratedMotion(parameters_, options_.wheel_base));
  window_.first_covariance = last;
}

void OdometryCalibration::interrupt() {
  window_.last_covariance.setZero();
  start_window();
}

OdometryCalibration::Outcome OdometryCalibration::add(const SE2& T_before_now,
                                                      const SE2& T_laser_before_now,
                                                      const Eigen::Matrix3d& covariance) {
  // Where a new window begins, the pose before was about as well known as this one.
  if (window_.is_empty && window_.first_covariance.isZero()) window_.first_covariance = covariance;
  window_.is_empty = false;
  window_.motion.add(T_before_now);
  window_.T_laser_first_now = window_.T_laser_first_now * T_laser_before_now;
  window_.meters += T_before_now.p.norm();
  window_.radians += std::abs(T_before_now.angle);
  window_.last_covariance = covariance;
  if (window_.meters < options_.distance && window_.radians < options_.turn) {
    return Outcome::kPending;
  }
  const Outcome outcome = use_window();
  start_window();
  return outcome;
}

Eigen::Matrix<double, 3, kCalibrationParameters> OdometryCalibration::shown_by_window() const {
  Eigen::Matrix<double, 3, kCalibrationParameters> H = window_.motion.laser_jacobian();
  const SE2 moved = window_.motion.of_base();
  if (moved.p.norm() < options_.smallest_distance) {
    H.col(kDistanceScale).setZero();
    H.col(kYawDrift).setZero();
  }
  if (std::abs(moved.angle) < options_.smallest_turn) {
    H.col(kTurnScale).setZero();
    H.col(kLaserX).setZero();
    H.col(kLaserY).setZero();
  }
  return H;
}

Eigen::Matrix3d OdometryCalibration::noise_of_window(const Eigen::Matrix3d& covariance) const {
  const double distance = options_.distance_noise * options_.distance_noise * window_.meters;
  const double yaw = options_.yaw_noise * options_.yaw_noise * window_.meters +
                     options_.turn_noise * options_.turn_noise * window_.radians;
  const Eigen::Vector3d of_base(distance, distance, yaw);
  const SE2::Adjoint Ad =
      SE2::from_xy_yaw(parameters_[kLaserX], parameters_[kLaserY], parameters_[kLaserYaw])
          .inverse()
          .adjoint();
  return covariance + Ad * of_base.asDiagonal() * Ad.transpose();
}

void OdometryCalibration::let_walk() {
  for (int i = 0; i < kCalibrationParameters; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double first = options_.sigma[k] * options_.sigma[k];
    const double grown = covariance_(i, i) + window_.meters * options_.walk[k] * options_.walk[k];
    if (grown < first) covariance_(i, i) = grown;
  }
}

OdometryCalibration::Outcome OdometryCalibration::use_window() {
  let_walk();
  const SE2 T_laser_expected = window_.motion.of_laser();
  const Eigen::Vector3d r = (T_laser_expected.inverse() * window_.T_laser_first_now).log();
  const SE2::Adjoint Ad = T_laser_expected.inverse().adjoint();
  const Eigen::Matrix3d R =
      noise_of_window(window_.last_covariance + Ad * window_.first_covariance * Ad.transpose());
  const Eigen::Matrix<double, 3, kCalibrationParameters> H = shown_by_window();
  const Eigen::Matrix3d S = H * covariance_ * H.transpose() + R;
  const Eigen::LLT<Eigen::Matrix3d> factor(S);
  if (!r.allFinite() || factor.info() != Eigen::Success ||
      r.dot(factor.solve(r)) > options_.largest_distance2) {
    ++outliers_;
    return Outcome::kOutlier;
  }
  const Eigen::Matrix<double, kCalibrationParameters, 3> K =
      factor.solve(H * covariance_).transpose();
  parameters_ += K * r;
  const CalibrationMatrix rest = CalibrationMatrix::Identity() - K * H;
  covariance_ = (rest * covariance_ * rest.transpose() + K * R * K.transpose()).eval();
  information_ += H.transpose() * R.llt().solve(H);
  ++used_;
  return Outcome::kUsed;
}

SE2 OdometryCalibration::calibrated(const SE2& T_before_now) const {
  CalibratedMotion motion(parameters_, options_.wheel_base);
  motion.add(T_before_now);
  return T_base_laser_nominal_ * motion.of_laser() * T_base_laser_nominal_.inverse();
}

double OdometryCalibration::sigma(CalibrationParameter parameter) const {
  return std::sqrt(covariance_(parameter, parameter));
}

bool OdometryCalibration::is_observed(CalibrationParameter parameter) const {
  const CalibrationVector sigma = as_vector(options_.sigma);
  const CalibrationMatrix whitened = sigma.asDiagonal() * information_ * sigma.asDiagonal() +
                                     kWeakBelief * CalibrationMatrix::Identity();
  return whitened.inverse()(parameter, parameter) < kObservedVariance;
}

std::optional<DifferentialDrive> OdometryCalibration::drive() const {
  if (options_.wheel_base <= 0.0) return std::nullopt;
  DifferentialDrive drive;
  drive.wheel_base = options_.wheel_base * parameters_[kDistanceScale] / parameters_[kTurnScale];
  const double half = 0.5 * parameters_[kYawDrift] * drive.wheel_base;
  drive.left_scale = parameters_[kDistanceScale] - half;
  drive.right_scale = parameters_[kDistanceScale] + half;
  return drive;
}

}  // namespace trident::slam
