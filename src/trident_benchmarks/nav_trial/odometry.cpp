// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "odometry.h"

#include <algorithm>
#include <cmath>

#include "trident_base/random_stream.h"

namespace trident::benchmarks {
namespace {

constexpr double kKept_s = 2.0;

double sign_of(const RandomStream& random, std::uint32_t channel) {
  return random.uniform(0, channel) < 0.5 ? -1.0 : 1.0;
}

}  // namespace

DriftingOdometry::DriftingOdometry(const OdometryParams& params, std::uint64_t seed)
    : params_(params), seed_(seed) {
  const RandomStream random(seed, "drifting_odometry");
  distance_scale_ = 1.0 + sign_of(random, 0) * params.distance_error;
  turn_scale_ = 1.0 + sign_of(random, 1) * params.turn_error;
}

void DriftingOdometry::add(const SE2& T_fixed_base, const nav::Twist2& twist) {
  if (count_++ > 0) {
    const SE2 moved = T_fixed_last_.inverse() * T_fixed_base;
    const double walk = params_.yaw_walk * std::sqrt(moved.p.norm()) *
                        RandomStream(seed_, "drifting_odometry").normal(count_, 2);
    T_odom_base_ = T_odom_base_ * SE2::from_xy_yaw(distance_scale_ * moved.p.x(),
                                                   distance_scale_ * moved.p.y(),
                                                   turn_scale_ * moved.angle + walk);
  }
  T_fixed_last_ = T_fixed_base;
  pose_ = {T_odom_base_.p.x(), T_odom_base_.p.y(), T_odom_base_.angle};
  twist_ = {distance_scale_ * twist.vx, distance_scale_ * twist.vy, turn_scale_ * twist.wz};
}

void PoseHistory::add(double time_s, const nav::Pose2& pose) {
  poses_.push_back({time_s, SE2::from_xy_yaw(pose.x, pose.y, pose.yaw)});
  while (poses_.front().time_s < time_s - kKept_s) poses_.pop_front();
}

SE2 PoseHistory::at(double time_s) const {
  const auto after = std::find_if(poses_.begin(), poses_.end(), [time_s](const Stamped& stamped) {
    return stamped.time_s >= time_s;
  });
  if (after == poses_.end()) return poses_.back().pose;
  if (after == poses_.begin()) return after->pose;
  const Stamped& before = *(after - 1);
  const double share = (time_s - before.time_s) / (after->time_s - before.time_s);
  return before.pose * SE2::exp(share * (before.pose.inverse() * after->pose).log());
}

}  // namespace trident::benchmarks
