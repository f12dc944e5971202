// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/vehicle/diff_drive_odometry.h"

#include <cmath>
#include <string>

#include "trident_base/angle.h"
#include "trident_base/error.h"

namespace trident {
namespace {

/// Below this a series is more accurate than the quotient.
constexpr double kSmall_rad = 1e-3;

void check(bool ok, const char* field, double value, const char* legal) {
  if (ok && std::isfinite(value)) return;
  throw Error(std::string("odometry: ") + field + " is " + std::to_string(value) + ", must be " +
              legal);
}

/// sin(x) / x.
double sinc(double x) { return std::abs(x) < kSmall_rad ? 1.0 - x * x / 6.0 : std::sin(x) / x; }
/// Of sinc(x); the series is -x / 3 + x^3 / 30 - ...
double sinc_derivative(double x) {
  if (std::abs(x) < kSmall_rad) return -x / 3.0 + x * x * x / 30.0;
  return (x * std::cos(x) - std::sin(x)) / (x * x);
}

}  // namespace

void validate(const DiffDriveOdometryParams& params) {
  check(params.wheel_separation_m > 0.0, "wheel_separation_m", params.wheel_separation_m, "> 0");
  check(params.wheel_radius_m > 0.0, "wheel_radius_m", params.wheel_radius_m, "> 0");
  check(params.travel_variance_m >= 0.0, "travel_variance_m", params.travel_variance_m, ">= 0");
}

WheelArc::WheelArc(double left_m, double right_m, double separation_m)
    : turn_rad((right_m - left_m) / separation_m),
      separation_m_(separation_m),
      sinc_(sinc(0.5 * turn_rad)),
      sinc_by_half_turn_(sinc_derivative(0.5 * turn_rad)),
      length_m_(0.5 * (left_m + right_m)) {
  chord_m = length_m_ * sinc_;
}

SE2 WheelArc::applied_to(const SE2& T_odom_base) const {
  // The chord of an arc points to the mean of the headings at its ends.
  const double along = T_odom_base.angle + 0.5 * turn_rad;
  SE2 result;
  result.p = T_odom_base.p + chord_m * Eigen::Vector2d(std::cos(along), std::sin(along));
  result.angle = wrap_to_pi(T_odom_base.angle + turn_rad);
  return result;
}

Eigen::Matrix3d WheelArc::jacobian_pose(double yaw_before) const {
  const double along = yaw_before + 0.5 * turn_rad;
  Eigen::Matrix3d result = Eigen::Matrix3d::Identity();
  result(0, 2) = -chord_m * std::sin(along);
  result(1, 2) = chord_m * std::cos(along);
  return result;
}

Eigen::Matrix<double, 3, 2> WheelArc::jacobian_travel(double yaw_before) const {
  const double along = yaw_before + 0.5 * turn_rad;
  const Eigen::Vector2d ahead(std::cos(along), std::sin(along));
  const Eigen::Vector2d aside(-ahead.y(), ahead.x());
  Eigen::Matrix<double, 3, 2> result;
  for (int wheel = 0; wheel < 2; ++wheel) {
    // Product rule: a wheel's travel changes the chord's length and, by the turn, its direction.
    const double turn_by_travel = (wheel == 0 ? -1.0 : 1.0) / separation_m_;
    const double half = 0.5 * turn_by_travel;
    const double chord_by_travel = 0.5 * sinc_ + length_m_ * sinc_by_half_turn_ * half;
    result.block<2, 1>(0, wheel) = chord_by_travel * ahead + chord_m * half * aside;
    result(2, wheel) = turn_by_travel;
  }
  return result;
}

DiffDriveOdometry::DiffDriveOdometry(const DiffDriveOdometryParams& params) : params_(params) {
  validate(params);
}

void DiffDriveOdometry::update(double left_rad, double right_rad) {
  const double left = params_.wheel_radius_m * left_rad;
  const double right = params_.wheel_radius_m * right_rad;
  const WheelArc arc(left, right, params_.wheel_separation_m);
  if (params_.travel_variance_m > 0.0) {
    const double yaw = T_odom_base_.angle;
    const Eigen::Matrix3d by_pose = arc.jacobian_pose(yaw);
    const Eigen::Matrix<double, 3, 2> by_travel = arc.jacobian_travel(yaw);
    // Errors of the wheels are independent, with a variance that grows with the travel of each.
    const Eigen::Vector2d travel =
        params_.travel_variance_m * Eigen::Vector2d(std::abs(left), std::abs(right));
    covariance_ = by_pose * covariance_ * by_pose.transpose() +
                  by_travel * travel.asDiagonal() * by_travel.transpose();
  }
  T_odom_base_ = arc.applied_to(T_odom_base_);
  distance_m_ += 0.5 * (left + right);
}

void DiffDriveOdometry::reset() {
  T_odom_base_ = SE2();
  covariance_.setZero();
  distance_m_ = 0.0;
}

}  // namespace trident
