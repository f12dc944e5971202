// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "steering.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trident::nav {

Point2 to_base(const Pose2& pose, const Point2& point) {
  const double c = std::cos(pose.yaw);
  const double s = std::sin(pose.yaw);
  const double dx = point.x - pose.x;
  const double dy = point.y - pose.y;
  return {c * dx + s * dy, c * dy - s * dx};
}

Point2 lookahead_point(const LocalPath& path, const Pose2& pose, double radius_m) {
  Point2 before{path.poses.front().x, path.poses.front().y};
  double before_m = distance(before.x, before.y, pose.x, pose.y);
  // Off the path by more than the radius: its nearest point.
  if (before_m >= radius_m) return before;
  for (const Pose2& p : path.poses) {
    const double d = distance(p.x, p.y, pose.x, pose.y);
    if (d >= radius_m) {
      const double t = d > before_m ? (radius_m - before_m) / (d - before_m) : 1.0;
      return {before.x + t * (p.x - before.x), before.y + t * (p.y - before.y)};
    }
    before = {p.x, p.y};
    before_m = d;
  }
  return before;
}

double distance_left(const Situation& situation) {
  const Pose2& pose = situation.state.pose;
  const Pose2& end = situation.path.poses.back();
  return std::max(situation.path.remaining_m, distance(pose.x, pose.y, end.x, end.y));
}

bool is_arc_clear(const Situation& situation, double sign, double curvature, double length_m,
                  double margin_m) {
  const Footprint& footprint = situation.checker.footprint();
  const auto room_m = [&](const Pose2& pose) {
    return clearance_m(situation.grid, pose, footprint, 1.0);
  };
  const double kept_m = std::min(margin_m, room_m(situation.state.pose));
  const double reach = 1.0 + footprint.circumscribed_radius * std::fabs(curvature);
  const double step_m = 0.5 * situation.grid.geometry.resolution / reach;
  const int steps = 1 + static_cast<int>(std::min(length_m / step_m, 1e4));
  const Twist2 unit{sign, 0.0, curvature};
  for (int i = 1; i <= steps; ++i) {
    const Pose2 pose = integrate(situation.state.pose, unit, length_m * i / steps);
    if (!situation.checker.is_free(situation.grid, pose)) return false;
    if (margin_m > 0.0 && room_m(pose) < kept_m) return false;
  }
  return true;
}

double turning_rate(const MotionLimits& limits, double angle, double period_s) {
  const double wz = stopping_speed(std::fabs(angle), limits.alpha_max, period_s);
  return std::copysign(std::min(wz, limits.wz_max), angle);
}

Twist2 slowed_to(double speed, const Twist2& twist) {
  const double own = std::hypot(twist.vx, twist.vy);
  if (own <= speed || own == 0.0) return twist;
  const double kept = speed / own;
  return {kept * twist.vx, kept * twist.vy, kept * twist.wz};
}

std::optional<Twist2> straight_to_goal(const Situation& situation, const ControlSetup& setup,
                                       double within_m) {
  const Pose2& pose = situation.state.pose;
  const double left_m = distance_left(situation);
  if (!setup.can_turn_on_spot() || !situation.path.reaches_goal || left_m > within_m) {
    return std::nullopt;
  }
  const Point2 goal = to_base(pose, {situation.goal.x, situation.goal.y});
  const double bearing = std::atan2(goal.y, goal.x);
  const double straight_m = std::hypot(goal.x, goal.y);
  // Once it drives, small errors are steered away.
  constexpr double kAligned = 0.15;  // [rad]
  const Twist2 turn{0.0, 0.0, turning_rate(setup.limits, bearing, setup.period_s)};
  if (std::fabs(bearing) > kAligned) return turn;
  const double curvature = 2.0 * goal.y / std::max(straight_m * straight_m, 1e-6);
  if (!is_arc_clear(situation, 1.0, curvature, straight_m)) return std::nullopt;
  const double v = std::min(stopping_speed(straight_m, setup.limits.decel_max, setup.period_s),
                            setup.limits.vx_max);
  return Twist2{v, 0.0, v * curvature};
}

double clearance_m(const CostGrid& grid, const Pose2& pose, const Footprint& footprint,
                   double cost_scaling_factor) {
  const Cell cell = grid.geometry.cell(pose.x, pose.y);
  if (!grid.geometry.contains(cell)) return std::numeric_limits<double>::infinity();
  if (grid.distance_m != nullptr) {
    const double d = grid.distance_m[grid.geometry.index(cell)];
    return std::max(d - footprint.inscribed_radius, 0.0);
  }
  const std::uint8_t cost = grid.at(cell);
  if (cost == kFreeCost || cost == kUnknownCost) return std::numeric_limits<double>::infinity();
  if (cost >= kInscribedCost) return 0.0;
  return std::log(252.0 / cost) / cost_scaling_factor;
}

}  // namespace trident::nav
