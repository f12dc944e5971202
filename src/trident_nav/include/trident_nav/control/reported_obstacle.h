// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "trident_nav/control/robot_state.h"
#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// An obstacle as others report it, in the costmap's frame.
struct ReportedObstacle {
  std::int64_t id = 0;          ///< The same in other reports for the same obstacle.
  std::vector<Point2> outline;  ///< One point: a disc; two: a line; more: a closed polygon [m].
  double radius_m = 0.0;        ///< Of a disc, and added around lines and polygons.
  Point2 velocity;              ///< [m/s]
  /// Variances of the velocity along x and y [m^2/s^2].
  Point2 velocity_variance;
};

/// Discs that cover an obstacle's outline, each a track with the obstacle's velocity: one about
/// what is small, a row along the edges of what is large, so that a long wall does not become a
/// wide disc. An obstacle without points gives none.
Tracks covering_tracks(const ReportedObstacle& obstacle);

}  // namespace trident::nav
