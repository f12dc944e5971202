// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// Where a pose to reach is, as the robot sees it.
struct EgocentricPose {
  double distance_m = 0.0;
  double phi = 0.0;    ///< Heading of the pose, from the line of sight [rad].
  double delta = 0.0;  ///< Heading of the robot, from the line of sight [rad].
};

/// For a robot that drives backwards both headings are turned by half a turn.
EgocentricPose egocentric(const Pose2& robot, const Pose2& target, bool is_backward);

struct SmoothLawGains {
  double k_phi = 2.0;
  double k_delta = 1.0;
};

/// Curvature of the motion that leads the robot to the pose and to its heading, positive to the
/// left [1/m]. Park and Kuipers, "A smooth control law for graceful motion of differential wheeled
/// mobile robots in 2D environments", ICRA (2011), equation 13.
double smooth_curvature(const EgocentricPose& target, const SmoothLawGains& gains);

}  // namespace trident::nav
