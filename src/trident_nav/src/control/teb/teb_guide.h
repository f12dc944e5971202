// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "teb_problem.h"

namespace trident::nav {

/// Where bands lead, by the path ahead.
struct TebGuide {
  std::vector<Point2> points;  ///< The robot's position, the path's points, the end.
  Pose2 start, goal;
  TebTask task;
};

TebGuide make_guide(const TebModel& model, const Situation& situation);

/// A first guess of a band along points: headings by the direction of travel, and where the robot
/// turns on the spot and looks elsewhere, a turn before it.
TebBand guess_band(const TebModel& model, const TebGuide& guide, const std::vector<Point2>& points);

/// The heading of the first part of a line from its first point, of a length [m, rad].
double first_direction(const std::vector<Point2>& points, double length_m);

}  // namespace trident::nav
