// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "odometry.h"
#include "trial_config.h"
#include "trident_nav/core/geometry.h"

namespace trident::benchmarks {

/// Dead reckoning as a robot with encoders and a gyro has it: travel of the wheels, turned by the
/// integral of the measured rate. Errors of wheels and gyro are drawn once, from the seed.
class WheelOdometry : public Odometry {
 public:
  WheelOdometry(const OdometryParams& params, std::uint64_t seed);

  /// What the gyro measures now [rad/s], `elapsed_s` after it last did.
  void add_rate(double rate_rad_s, double elapsed_s);
  /// How far the wheels of both sides have turned since the beginning [rad], `elapsed_s` after the
  /// last call.
  void add_turns(double left_rad, double right_rad, double elapsed_s);

  const nav::Pose2& pose() const override { return pose_; }
  const nav::Twist2& twist() const override { return twist_; }

 private:
  OdometryParams params_;
  double left_radius_m_, right_radius_m_, bias_rad_s_;
  double travel_m_ = 0.0;  ///< Of the base, as last read.
  double yaw_ = 0.0;       ///< Integral of the gyro.
  nav::Pose2 pose_;
  nav::Twist2 twist_;
};

}  // namespace trident::benchmarks
