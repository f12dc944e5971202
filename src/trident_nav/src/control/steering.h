// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "trident_nav/control/control_law.h"

namespace trident::nav {

/// A point of the costmap's frame in the base's axes [m].
Point2 to_base(const Pose2& pose, const Point2& point);

/// Where the path ahead leaves a circle about the robot; its end if it does not [m].
Point2 lookahead_point(const LocalPath& path, const Pose2& pose, double radius_m);

/// How far the robot has yet to drive: along the path, and no less than straight to its end [m].
double distance_left(const Situation& situation);

/// Whether an arc from where the robot is touches nothing: `sign` 1 forward, -1 backward;
/// `curvature` of the motion in the base's axes [1/m]; up to an arc length [m].
/// `margin_m` more than the inscribed circle is kept free, too, where the robot has that now.
bool is_arc_clear(const Situation& situation, double sign, double curvature, double length_m,
                  double margin_m = 0.0);

/// The turn rate toward a heading that is `angle` away, which brakes in time [rad/s].
double turning_rate(const MotionLimits& limits, double angle, double period_s);

/// A motion on the same curve that is no faster than a speed [m/s].
Twist2 slowed_to(double speed, const Twist2& twist);

/// Straight to the goal for a robot that turns on the spot, where it is nearer than `within_m` and
/// nothing is between: a turn toward it, then no faster than it can stop. Nothing elsewhere.
std::optional<Twist2> straight_to_goal(const Situation& situation, const ControlSetup& setup,
                                       double within_m);

/// Distance from the inscribed circle to the nearest obstacle, at least 0 [m]: of the distance
/// field, or else from the inflation's cost with its scaling factor [1/m].
double clearance_m(const CostGrid& grid, const Pose2& pose, const Footprint& footprint,
                   double cost_scaling_factor);

}  // namespace trident::nav
