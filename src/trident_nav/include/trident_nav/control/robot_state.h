// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// Where the robot is and how it moves.
struct RobotState {
  Pose2 pose;           ///< Of the base in the costmap's frame.
  Twist2 twist;         ///< Measured, in the base's axes.
  double time_s = 0.0;  ///< Of the measurement; never decreases.
};

/// A moving obstacle at the time of the robot's state, in the costmap's frame. What it covers may
/// be marked in the costmap or not.
struct Track {
  int id = 0;  ///< The same as long as it is the same object.
  Point2 position;
  Point2 velocity;        ///< [m/s]
  double radius_m = 0.0;  ///< Of the circle that encloses it.
  /// Of (x, y, vx, vy), row by row [m^2, m^2/s, m^2/s^2].
  std::array<double, 16> covariance{};
  /// For how long no sensor has seen it: it is hidden, or out of all fields of view [s].
  double unseen_s = 0.0;

  Point2 position_at(double after_s) const {
    return {position.x + velocity.x * after_s, position.y + velocity.y * after_s};
  }
  /// Standard deviation of the predicted position along the axis that is known less [m].
  double position_sigma(double after_s) const;
};

using Tracks = std::vector<Track>;

}  // namespace trident::nav
