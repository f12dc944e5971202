// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "smooth_law.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::nav {

EgocentricPose egocentric(const Pose2& robot, const Pose2& target, bool is_backward) {
  const double dx = target.x - robot.x;
  const double dy = target.y - robot.y;
  const double sight = std::atan2(dy, dx) + (is_backward ? kPi : 0.0);
  return {std::hypot(dx, dy), wrap_angle(target.yaw - sight), wrap_angle(robot.yaw - sight)};
}

double smooth_curvature(const EgocentricPose& target, const SmoothLawGains& gains) {
  constexpr double kNearest = 1e-3;  // [m]
  const double scaled = gains.k_phi * target.phi;
  // The heading that the pose's own one asks for at this distance, and how fast it changes.
  const double error = target.delta - std::atan(-scaled);
  const double feed_forward = 1.0 + gains.k_phi / (1.0 + scaled * scaled);
  return -(gains.k_delta * error + feed_forward * std::sin(target.delta)) /
         std::max(target.distance_m, kNearest);
}

}  // namespace trident::nav
