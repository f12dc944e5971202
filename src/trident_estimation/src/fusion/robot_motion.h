// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "trident_estimation/fusion/team_model.h"

namespace trident::estimation {

/// Of a robot's pose, velocity and angular velocity: TeamModel::kPosition ... kMap.
using MotionMatrix = Eigen::Matrix<double, 12, 12>;

/// The state `dt` [s] later, in steps of at most kMaxStep_s.
RobotState moved(const RobotMotion& motion, const RobotState& robot, double dt);
/// How that follows from the state, by degrees of freedom.
MotionMatrix motion_jacobian(const RobotMotion& motion, const RobotState& robot, double dt);
/// The covariance that the time adds.
MotionMatrix motion_noise(const RobotMotion& motion, const RobotState& robot, double dt);

}  // namespace trident::estimation
