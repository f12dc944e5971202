// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "wheel_odometry.h"

#include <cmath>

#include "trident_base/angle.h"
#include "trident_base/random_stream.h"

namespace trident::benchmarks {

WheelOdometry::WheelOdometry(const OdometryParams& params, std::uint64_t seed) : params_(params) {
  const RandomStream random(seed, "wheel_odometry");
  left_radius_m_ = params.wheel_radius * (1.0 + params.radius_error * random.normal(0, 0));
  right_radius_m_ = params.wheel_radius * (1.0 + params.radius_error * random.normal(0, 1));
  bias_rad_s_ = params.gyro_bias * random.normal(0, 2);
}

void WheelOdometry::add_rate(double rate_rad_s, double elapsed_s) {
  const double measured = rate_rad_s + bias_rad_s_;
  // The mean of two measurements is exact for a rate that changes evenly between them.
  yaw_ += 0.5 * (twist_.wz + measured) * elapsed_s;
  twist_.wz = measured;
}

void WheelOdometry::add_turns(double left_rad, double right_rad, double elapsed_s) {
  const double tick = 2.0 * kPi / params_.ticks_per_turn;
  const double left_m = left_radius_m_ * tick * std::floor(left_rad / tick);
  const double right_m = right_radius_m_ * tick * std::floor(right_rad / tick);
  const double travel_m = 0.5 * (left_m + right_m);
  const double moved_m = travel_m - travel_m_;
  const double middle = pose_.yaw + 0.5 * (yaw_ - pose_.yaw);
  pose_ = {pose_.x + moved_m * std::cos(middle), pose_.y + moved_m * std::sin(middle), yaw_};
  twist_.vx = moved_m / elapsed_s;
  travel_m_ = travel_m;
}

}  // namespace trident::benchmarks
