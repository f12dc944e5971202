// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "trident_nav/core/geometry.h"

namespace trident::nav {

/// A pose of a band and the time from it to the next one.
struct TebNode {
  Pose2 pose;
  double dt_s = 0.0;  ///< Of the last one 0.
};

/// A timed elastic band: poses and the durations between them. Rösmann, Feiten, Wösch, Hoffmann,
/// Bertram, "Trajectory modification considering dynamic constraints of autonomous robots",
/// ROBOTIK 2012, equations (1) to (3). The first pose is the robot's, the last one the goal.
using TebBand = std::vector<TebNode>;

/// No duration of a band is shorter [s].
constexpr double kMinTebDuration_s = 0.01;

/// The speeds that first guesses of durations are made with.
struct TebPace {
  double v = 0.0;   ///< [m/s]
  double wz = 0.0;  ///< [rad/s]
};

/// How far apart the poses of a band are.
struct TebSpacing {
  double dt_ref_s = 0.3;         ///< Wanted.
  double dt_hysteresis_s = 0.1;  ///< Allowed off that.
  double max_step_m = 0.3;       ///< So that no obstacle fits between two poses.
  double max_turn = 0.8;         ///< [rad]
  std::size_t min_nodes = 3, max_nodes = 500;
};

/// The whole duration [s].
double duration_s(const TebBand& band);

/// A band through poses in order, with durations by the pace. Throws nothing; needs two poses.
TebBand band_through(const Path& poses, const TebPace& pace);

/// Gives the segments of a band that are faster than the pace as much time as it takes: durations
/// far too short, as after a new end, are what an optimization hardly finds out of.
void slow_down(const TebPace& pace, TebBand* band);

/// Splits what is too long and joins what is too short, so that the durations come near to the
/// wanted one. Rösmann et al. 2012, section 3.
void resize_band(const TebSpacing& spacing, TebBand* band);

/// Begins a kept band at another pose, and ends it at another one: what the robot has passed is cut
/// off, and so are first poses that are all within `reach_m` of it, where a band is prone to coil.
void move_ends(const Pose2& start, const Pose2& goal, double reach_m, TebBand* band);

}  // namespace trident::nav
