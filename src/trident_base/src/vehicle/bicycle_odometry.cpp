// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/vehicle/bicycle_odometry.h"

#include <cmath>
#include <string>

#include "trident_base/error.h"
#include "trident_base/vehicle/diff_drive_odometry.h"

namespace trident {
namespace {

void check(bool ok, const char* field, double value, const char* legal) {
  if (ok && std::isfinite(value)) return;
  throw Error(std::string("car: ") + field + " is " + std::to_string(value) + ", must be " + legal);
}

}  // namespace

void validate(const AckermannGeometry& geometry) {
  check(geometry.wheelbase_m > 0.0, "wheelbase_m", geometry.wheelbase_m, "> 0");
  check(geometry.front_track_m > 0.0, "front_track_m", geometry.front_track_m, "> 0");
  check(geometry.rear_track_m > 0.0, "rear_track_m", geometry.rear_track_m, "> 0");
}

Eigen::Vector2d AckermannGeometry::wheel_angles(double steering_rad) const {
  // Each wheel is square to the line to the turning point at (0, wheelbase / tan(steering)).
  const double s = std::sin(steering_rad), c = std::cos(steering_rad);
  const double aside = 0.5 * front_track_m / wheelbase_m * s;
  return {std::atan2(s, c - aside), std::atan2(s, c + aside)};
}

// Each wheel alone gives the bicycle's angle by Ackermann's condition, cot(left) = cot(steering) -
// track / (2 wheelbase) and with the other sign on the right; measured angles differ, so that the
// mean of both tangents is taken.
double AckermannGeometry::steering_of(double left_rad, double right_rad) const {
  const double half = 0.5 * front_track_m / wheelbase_m;
  const double by_left = std::tan(left_rad) / (1.0 + half * std::tan(left_rad));
  const double by_right = std::tan(right_rad) / (1.0 - half * std::tan(right_rad));
  return std::atan(0.5 * (by_left + by_right));
}

double AckermannGeometry::steering_of_inner(double inner_rad) const {
  const double half = 0.5 * front_track_m / wheelbase_m;
  return std::atan2(std::sin(inner_rad), std::cos(inner_rad) + half * std::sin(inner_rad));
}

// Rear wheels roll on circles about the turning point, by half the track nearer and farther.
Eigen::Vector2d AckermannGeometry::rear_speeds(double speed, double steering_rad) const {
  const double part = 0.5 * rear_track_m / wheelbase_m * std::tan(steering_rad);
  return {speed * (1.0 - part), speed * (1.0 + part)};
}

void validate(const BicycleOdometryParams& params) {
  check(params.wheelbase_m > 0.0, "wheelbase_m", params.wheelbase_m, "> 0");
  check(params.wheel_radius_m > 0.0, "wheel_radius_m", params.wheel_radius_m, "> 0");
  check(params.travel_variance_m >= 0.0, "travel_variance_m", params.travel_variance_m, ">= 0");
  check(params.turn_variance_rad2_m >= 0.0, "turn_variance_rad2_m", params.turn_variance_rad2_m,
        ">= 0");
}

BicycleOdometry::BicycleOdometry(const BicycleOdometryParams& params) : params_(params) {
  validate(params);
}

void BicycleOdometry::update(double rear_rad, double steering_rad) {
  const double travel = params_.wheel_radius_m * rear_rad;
  // The bicycle model: the yaw rate is v tan(steering) / wheelbase.
  const double turn = travel * std::tan(steering_rad) / params_.wheelbase_m;
  // The same arc as that of two wheels 1 m apart.
  const WheelArc arc(travel - 0.5 * turn, travel + 0.5 * turn, 1.0);
  if (params_.travel_variance_m > 0.0 || params_.turn_variance_rad2_m > 0.0) {
    const double yaw = T_odom_axle_.angle;
    const Eigen::Matrix3d by_pose = arc.jacobian_pose(yaw);
    const Eigen::Matrix<double, 3, 2> by_wheels = arc.jacobian_travel(yaw);
    // Chain rule: left = travel - turn / 2, right = travel + turn / 2.
    Eigen::Matrix<double, 3, 2> by_motion;
    by_motion.col(0) = by_wheels.col(0) + by_wheels.col(1);
    by_motion.col(1) = 0.5 * (by_wheels.col(1) - by_wheels.col(0));
    // Variances grow with the path's length, whichever direction it is driven in.
    const Eigen::Vector2d variance =
        std::abs(travel) * Eigen::Vector2d(params_.travel_variance_m, params_.turn_variance_rad2_m);
    covariance_ = by_pose * covariance_ * by_pose.transpose() +
                  by_motion * variance.asDiagonal() * by_motion.transpose();
  }
  T_odom_axle_ = arc.applied_to(T_odom_axle_);
}

void BicycleOdometry::reset() {
  T_odom_axle_ = SE2();
  covariance_.setZero();
}

}  // namespace trident
