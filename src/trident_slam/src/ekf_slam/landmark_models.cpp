// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "landmark_models.h"

#include <cmath>

#include "trident_base/angle.h"

namespace trident::slam {
namespace {

Eigen::Matrix2d rotation(double yaw) {
  return (Eigen::Matrix2d() << std::cos(yaw), -std::sin(yaw), std::sin(yaw), std::cos(yaw))
      .finished();
}

Eigen::Vector2d turned_left(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

}  // namespace

/// x' = x + R(yaw) dp; yaw' = yaw + (1 + s) dyaw + b |dp|, with the scale error s and the drift b
/// of odometry as states 3 and 4; F is the derivative by the state.
Motion move(const RobotState& before, const SE2& T_before_now) {
  const double distance = T_before_now.p.norm();
  const Eigen::Vector2d step = rotation(before[2]) * T_before_now.p;
  Motion motion;
  motion.after = before;
  motion.after.head<2>() += step;
  motion.after[2] =
      wrap_to_pi(before[2] + T_before_now.angle * (1.0 + before[3]) + distance * before[4]);
  motion.F.setIdentity();
  motion.F.block<2, 1>(0, 2) = turned_left(step);
  motion.F(2, 3) = T_before_now.angle;
  motion.F(2, 4) = distance;
  return motion;
}

Sight see(const Eigen::Vector3d& pose, const Eigen::Vector2d& landmark_map) {
  const Eigen::Matrix2d R_base_map = rotation(pose[2]).transpose();
  Sight sight;
  sight.p_base = R_base_map * (landmark_map - pose.head<2>());
  sight.H.leftCols<2>() = -R_base_map;
  sight.H.col(2) = -turned_left(sight.p_base);
  sight.H.rightCols<2>() = R_base_map;
  return sight;
}

PlacedLandmark place(const Eigen::Vector3d& pose, const Eigen::Vector2d& p_base) {
  PlacedLandmark result;
  result.G_seen = rotation(pose[2]);
  const Eigen::Vector2d offset = result.G_seen * p_base;
  result.landmark_map = pose.head<2>() + offset;
  result.G_pose.leftCols<2>().setIdentity();
  result.G_pose.col(2) = turned_left(offset);
  return result;
}

}  // namespace trident::slam
