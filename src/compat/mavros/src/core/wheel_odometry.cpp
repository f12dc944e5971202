// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/wheel_odometry.h"

#include <cmath>
#include <string>
#include <utility>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_base/vehicle/diff_drive_odometry.h"

namespace trident::mavros {
namespace {

constexpr double kMinApart_m = 1e-5;
// Sideways nothing is measured: without it the variance would be 0 where the wheels are abeam.
constexpr double kSideVariance_m2_s2 = 1e-3;

/// Turn of a block that does not turn with the heading, and of one that does.
Eigen::Matrix3d planar_rotation(double angle) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return R;
}

}  // namespace

void WheelOdometryParams::validate() const {
  if (!wheel0) return;
  if (count > 1 && !wheel1) throw Error("wheel1 is missing, count is " + std::to_string(count));
  if (count > 1 && std::abs(wheel1->y - wheel0->y) < kMinApart_m) {
    throw Error("wheel1/y is " + number_text(wheel1->y) + ", legal: another one than wheel0/y");
  }
}

WheelOdometry::WheelOdometry(const WheelOdometryParams& params)
    : wheel0_(*params.wheel0),
      wheel1_(params.wheel1.value_or(*params.wheel0)),
      is_single_(params.count < 2 || !params.wheel1),
      wheel_variance_m2_s2_(params.vel_error * params.vel_error) {
  if (is_single_) wheel1_ = wheel0_;
  T_base_axle_.p = {wheel0_.x, -0.5 * (wheel0_.y + wheel1_.y)};
  T_odom_axle_ = T_base_axle_;
}

void WheelOdometry::set_yaw(double yaw) {
  const double turn = yaw - T_odom_axle_.angle;
  const Eigen::Matrix3d R = planar_rotation(turn);
  T_odom_axle_ = SE2::from_xy_yaw(0.0, 0.0, turn) * T_odom_axle_;
  axle_covariance_ = R * axle_covariance_ * R.transpose();
}

/// That of a vehicle that has started again is, too.
bool WheelOdometry::is_first_at(SimTime time) const { return !time_ || time < *time_; }

/// A first measurement is usable, and a later one of as many wheels as that before it.
bool WheelOdometry::is_usable(const std::vector<double>& values, SimTime time) const {
  if (values.empty()) return false;
  return is_first_at(time) || (time != *time_ && values.size() == values_.size());
}

std::optional<WheelOdometry::Step> WheelOdometry::advance(const std::vector<double>& values,
                                                          SimTime time) {
  if (!is_usable(values, time)) return std::nullopt;
  const bool is_first = is_first_at(time);
  if (values.size() == 1) is_single_ = true;
  const Step step{std::exchange(values_, values), is_first ? 0.0 : (time - *time_).seconds()};
  time_ = time;
  return is_first ? std::nullopt : std::optional(step);
}

std::optional<WheelMotion> WheelOdometry::add_distances(const std::vector<double>& distance_m,
                                                        SimTime time) {
  const std::optional<Step> step = advance(distance_m, time);
  if (!step) return std::nullopt;
  const double first = distance_m[0] - step->before[0];
  const double second = is_single_ ? first : distance_m[1] - step->before[1];
  return drive(first, second, step->dt_s);
}

std::optional<WheelMotion> WheelOdometry::add_turns(const std::vector<double>& rpm, SimTime time) {
  const std::optional<Step> step = advance(rpm, time);
  if (!step) return std::nullopt;
  const auto travel = [&](std::size_t i, double radius_m) {
    constexpr double kPerMinute_rad_s = 2.0 * kPi / 60.0;
    return 0.5 * (rpm[i] + step->before[i]) * kPerMinute_rad_s * radius_m * step->dt_s;
  };
  const double first = travel(0, wheel0_.radius);
  return drive(first, is_single_ ? first : travel(1, wheel1_.radius), step->dt_s);
}

WheelMotion WheelOdometry::drive(double travel0_m, double travel1_m, double dt_s) {
  const double apart =
      is_single_ ? 1.0 : wheel1_.y - wheel0_.y;  // positive: wheel 1 is the right one
  const WheelArc arc =
      apart > 0.0 ? WheelArc(travel0_m, travel1_m, apart) : WheelArc(travel1_m, travel0_m, -apart);
  const double yaw = T_odom_axle_.angle;
  const Eigen::Matrix3d by_pose = arc.jacobian_pose(yaw);
  const Eigen::Matrix<double, 3, 2> by_travel = arc.jacobian_travel(yaw);
  axle_covariance_ = by_pose * axle_covariance_ * by_pose.transpose() +
                     wheel_variance_m2_s2_ * dt_s * dt_s * by_travel * by_travel.transpose();
  T_odom_axle_ = arc.applied_to(T_odom_axle_);

  const SE2 T_axle_base = T_base_axle_.inverse();
  const Eigen::Vector2d lever = T_odom_axle_.rotation() * T_axle_base.p;
  Eigen::Matrix3d by_axle = Eigen::Matrix3d::Identity();
  by_axle(0, 2) = -lever.y();
  by_axle(1, 2) = lever.x();
  WheelMotion motion;
  motion.T_odom_base = T_odom_axle_ * T_axle_base;
  motion.pose_covariance = by_axle * axle_covariance_ * by_axle.transpose();
  const double speed = 0.5 * (travel0_m + travel1_m) / dt_s, turn_rate = arc.turn_rad / dt_s;
  const Eigen::Vector2d& to_base = T_axle_base.p;
  motion.twist = {speed - turn_rate * to_base.y(), turn_rate * to_base.x(), turn_rate};
  const double speed_variance = 0.5 * wheel_variance_m2_s2_;
  const double turn_variance = 2.0 * wheel_variance_m2_s2_ / (apart * apart);
  motion.twist_variance = {speed_variance + to_base.y() * to_base.y() * turn_variance,
                           to_base.x() * to_base.x() * turn_variance + kSideVariance_m2_s2,
                           turn_variance};
  return motion;
}

}  // namespace trident::mavros
