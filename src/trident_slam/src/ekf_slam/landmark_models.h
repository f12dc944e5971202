// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "trident_base/se2.h"

namespace trident::slam {

/// The robot's part of the state: x [m], y [m], yaw [rad] in the map; the share by which odometry
/// misjudges turns; its yaw drift [rad/m].
using RobotState = Eigen::Matrix<double, 5, 1>;

/// Where odometry's motion leads, with d(after) / d(before).
struct Motion {
  RobotState after;
  Eigen::Matrix<double, 5, 5> F;
};
Motion move(const RobotState& before, const SE2& T_before_now);

/// What is seen of a landmark, in the robot's frame [m], with d(seen) / d(x, y, yaw, landmark).
struct Sight {
  Eigen::Vector2d p_base;
  Eigen::Matrix<double, 2, 5> H;
};
Sight see(const Eigen::Vector3d& pose, const Eigen::Vector2d& landmark_map);

/// Where a landmark is that was seen at p_base, with d(landmark) / d(x, y, yaw) and / d(p_base).
struct PlacedLandmark {
  Eigen::Vector2d landmark_map;
  Eigen::Matrix<double, 2, 3> G_pose;
  Eigen::Matrix2d G_seen;
};
PlacedLandmark place(const Eigen::Vector3d& pose, const Eigen::Vector2d& p_base);

}  // namespace trident::slam
