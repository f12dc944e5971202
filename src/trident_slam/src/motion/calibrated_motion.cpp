// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "calibrated_motion.h"

#include <cmath>

namespace trident::slam {
namespace {

/// exp(t + d) = exp(t) exp(J d) to the first order; Sola et al., A micro Lie theory for state
/// estimation in robotics, equation 163.
Eigen::Matrix3d right_jacobian(const SE2::Tangent& t) {
  const double w = t[2];
  const bool is_small = std::abs(w) < 1e-4;
  const double sine = is_small ? 1.0 - w * w / 6.0 : std::sin(w) / w;
  const double half = is_small ? 0.5 * w : (1.0 - std::cos(w)) / w;
  const double x = is_small ? w / 6.0 : (w - std::sin(w)) / (w * w);
  const double y = is_small ? 0.5 - w * w / 24.0 : (1.0 - std::cos(w)) / (w * w);
  Eigen::Matrix3d J;
  J << sine, half, x * t[0] - y * t[1],  //
      -half, sine, x * t[1] + y * t[0],  //
      0.0, 0.0, 1.0;
  return J;
}

}  // namespace

CalibratedMotion::CalibratedMotion(const CalibrationVector& parameters, double wheel_base)
    : parameters_(parameters), wheel_base_(wheel_base) {}

void CalibratedMotion::add(const SE2& T_before_now) {
  const SE2::Tangent reported = T_before_now.log();
  const double scale = parameters_[kDistanceScale];
  const double turn = parameters_[kTurnScale];
  const double drift = parameters_[kYawDrift];
  const double arm = 0.25 * wheel_base_ * wheel_base_ / turn;
  const SE2::Tangent t(scale * (reported[0] + drift * arm * reported[2]), scale * reported[1],
                       turn * reported[2] + drift * reported[0]);
  Eigen::Matrix3d by_scales;
  by_scales << reported[0] + drift * arm * reported[2], -scale * drift * arm * reported[2] / turn,
      scale * arm * reported[2],  //
      reported[1], 0.0, 0.0,      //
      0.0, reported[2], reported[0];
  const SE2 step = SE2::exp(t);
  by_scales_ = step.inverse().adjoint() * by_scales_ + right_jacobian(t) * by_scales;
  T_first_base_ = T_first_base_ * step;
}

SE2 CalibratedMotion::T_base_laser() const {
  return SE2::from_xy_yaw(parameters_[kLaserX], parameters_[kLaserY], parameters_[kLaserYaw]);
}

SE2 CalibratedMotion::of_laser() const {
  return T_base_laser().inverse() * T_first_base_ * T_base_laser();
}

Eigen::Matrix<double, 3, kCalibrationParameters> CalibratedMotion::laser_jacobian() const {
  const SE2 T_base_laser = this->T_base_laser();
  Eigen::Matrix3d moved = Eigen::Matrix3d::Identity();  // tangent of T_base_laser by x, y, yaw
  moved.topLeftCorner<2, 2>() = T_base_laser.rotation().transpose();
  Eigen::Matrix<double, 3, kCalibrationParameters> J;
  J.leftCols<3>() = T_base_laser.inverse().adjoint() * by_scales_;
  // exp(-d) T exp(d) = T exp(d - T^-1's adjoint d)
  J.rightCols<3>() = (Eigen::Matrix3d::Identity() - of_laser().inverse().adjoint()) * moved;
  return J;
}

}  // namespace trident::slam
