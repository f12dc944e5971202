// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// A pose of a trajectory that a control law has weighed.
struct TrajectoryPoint {
  double after_s = 0.0;  ///< From the state of the command on.
  Pose2 pose;            ///< In the costmap's frame.
  Twist2 twist;          ///< From this pose on, in the base's axes.
};

/// A trajectory that a control law has weighed, and its cost in the units of the law.
struct ConsideredTrajectory {
  std::vector<TrajectoryPoint> points;
  double cost = 0.0;  ///< Negative: it is not admissible.
};

/// What a law says of a cell of the costmap.
struct CellScore {
  Point2 center;          ///< [m]
  double path = 0.0;      ///< Distance from the path [cells].
  double goal = 0.0;      ///< Distance from the end of the path ahead [cells].
  double occupied = 0.0;  ///< Cost of the costmap.
  double total = 0.0;     ///< The three by their weights; lower is better.
};

/// What somebody wants to look at. Laws note no more than that, and of it what their parameters
/// allow.
struct WatchedDetails {
  bool trajectories = false;  ///< All, or the selected one, as the law's parameters say.
  bool cells = false;
};

/// What a law has weighed for its last command, for pictures and messages.
struct ControlDetails {
  /// Of the state that the command was computed of [s]; nothing: no law was asked for it.
  std::optional<double> time_s;
  std::vector<ConsideredTrajectory> trajectories;
  std::optional<std::size_t> selected;  ///< Of `trajectories`.
  std::vector<CellScore> cells;
  std::vector<Point2> obstacles;   ///< Points that trajectories keep away from [m].
  std::vector<Point2> via_points;  ///< That trajectories are drawn to [m].
  /// Whether the law's parameters ask for a full report of the trajectories.
  bool wants_feedback = false;

  const ConsideredTrajectory* selected_trajectory() const {
    return selected ? &trajectories[*selected] : nullptr;
  }
};

}  // namespace trident::nav
