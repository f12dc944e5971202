// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/control/braking_guard.h"

#include <algorithm>
#include <cmath>

#include "trident_nav/control/motion.h"

namespace trident::nav {
namespace {

// A robot that stands does nobody harm.
constexpr double kHarmless_m_s = 0.02;

// The velocity that the base has after `duration_s` if it changes at its limits toward `target`.
Twist2 approached(const MotionLimits& limits, const Twist2& twist, const Twist2& target,
                  double duration_s) {
  constexpr double kUnlimited = 1e9;
  MotionLimits rates = limits;
  rates.vx_max = rates.vy_max = rates.wz_max = kUnlimited;
  rates.vx_min = -kUnlimited;
  return reachable_window(rates, twist, duration_s).clamp(target);
}

double outer_speed(const Footprint& footprint, const Twist2& twist) {
  return std::hypot(twist.vx, twist.vy) + footprint.circumscribed_radius * std::fabs(twist.wz);
}

// Whether a polygon has a point inside.
bool contains(const std::vector<Point2>& polygon, const Point2& point) {
  bool is_inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point2& a = polygon[i];
    const Point2& b = polygon[j];
    if ((a.y > point.y) == (b.y > point.y)) continue;
    if (point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) is_inside = !is_inside;
  }
  return is_inside;
}

}  // namespace

int occupied_cells_within(const Footprint& footprint, const CostGrid& grid, const Pose2& pose) {
  const double radius = footprint.circumscribed_radius;
  const Cell first = grid.geometry.cell(pose.x - radius, pose.y - radius);
  const Cell last = grid.geometry.cell(pose.x + radius, pose.y + radius);
  const double c = std::cos(pose.yaw);
  const double s = std::sin(pose.yaw);
  int count = 0;
  for (int y = std::max(first.y, 0); y <= std::min(last.y, grid.geometry.height - 1); ++y) {
    for (int x = std::max(first.x, 0); x <= std::min(last.x, grid.geometry.width - 1); ++x) {
      if (grid.at({x, y}) != kLethalCost) continue;
      const Point2 center = grid.geometry.center({x, y});
      const double dx = center.x - pose.x;
      const double dy = center.y - pose.y;
      const Point2 in_base{c * dx + s * dy, c * dy - s * dx};
      const bool is_in = footprint.points.empty() ? std::hypot(dx, dy) <= radius
                                                  : contains(footprint.points, in_base);
      count += is_in ? 1 : 0;
    }
  }
  return count;
}

double guard_padding_m(const Footprint& footprint) {
  return 0.002 + 0.01 * footprint.circumscribed_radius;
}

BrakingGuard::BrakingGuard(const MotionLimits& limits, const FootprintChecker& checker,
                           const FootprintChecker& padded_checker, double period_s)
    : limits_(limits), checker_(checker), padded_checker_(padded_checker), period_s_(period_s) {}

// 0: room to spare; 1: none; beyond: in contact, the deeper the more.
int BrakingGuard::tightness(const CostGrid& grid, const Pose2& pose) const {
  if (padded_checker_.is_free(grid, pose)) return 0;
  if (checker_.is_free(grid, pose)) return 1;
  return 2 + occupied_cells_within(checker_.footprint(), grid, pose);
}

double BrakingGuard::step_duration(const Pose2& pose, double speed, const CostGrid& grid) const {
  // No point of the footprint moves by more than the padding where an obstacle may be near, so
  // that no corner slips through between two poses; and not beyond what is free for sure.
  constexpr double kSqrt2 = 1.41421356237309505;
  const double padded_m = padded_checker_.footprint().circumscribed_radius;
  double step_m = std::max(padded_m - checker_.footprint().circumscribed_radius, 1e-3);
  const Cell cell = grid.geometry.cell(pose.x, pose.y);
  if (grid.distance_m != nullptr && grid.geometry.contains(cell)) {
    const double d = static_cast<double>(grid.distance_m[grid.geometry.index(cell)]);
    step_m = std::max(step_m, d - padded_m - kSqrt2 * grid.geometry.resolution);
  }
  constexpr double kCoarse = 0.25;  // of a period, for the integration
  return speed > 0.0 ? std::clamp(step_m / speed, 1e-5, kCoarse * period_s_) : kCoarse * period_s_;
}

// Of what no sensor has seen for a while, as it walks behind the robot, it is only known about
// where it is: the robot may leave, but not drive there.
bool BrakingGuard::is_hit(const Pose2& pose, double after_s, const Twist2& twist,
                          const Track& track) const {
  constexpr double kSeen_s = 0.3;
  constexpr double kMaxUnknown_m = 1.0;
  const Point2 p = track.position_at(after_s);
  const double d = distance(p.x, p.y, pose.x, pose.y);
  const double reach = checker_.footprint().circumscribed_radius + track.radius_m;
  if (track.unseen_s <= kSeen_s) return d <= reach;
  const double sigma_m = track.position_sigma(after_s);
  // Corners sweep over what is next to the robot as it turns.
  const double radius_m = checker_.footprint().circumscribed_radius;
  const bool sweeps = radius_m * std::fabs(twist.wz) > kHarmless_m_s;
  if (sweeps && d <= reach + std::min(sigma_m, radius_m)) return true;
  if (d > reach + std::min(sigma_m, kMaxUnknown_m)) return false;
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  const Point2 v{c * twist.vx - s * twist.vy, s * twist.vx + c * twist.vy};
  return v.x * (p.x - pose.x) + v.y * (p.y - pose.y) > kHarmless_m_s * d;
}

std::optional<int> BrakingGuard::hit_track(const Pose2& pose, double after_s, const Twist2& twist,
                                           const Tracks& tracks) const {
  if (outer_speed(checker_.footprint(), twist) < kHarmless_m_s) return std::nullopt;
  for (const Track& track : tracks) {
    if (is_hit(pose, after_s, twist, track)) return track.id;
  }
  return std::nullopt;
}

double BrakingGuard::advance(const Twist2& command, const CostGrid& grid, double t, Pose2* pose,
                             Twist2* twist) const {
  const bool is_commanded = t < period_s_;
  const double present = outer_speed(checker_.footprint(), *twist);
  const double speed =
      is_commanded ? std::max(present, outer_speed(checker_.footprint(), command)) : present;
  double dt = step_duration(*pose, speed, grid);
  if (is_commanded) dt = std::min(dt, std::max(period_s_ - t, 1e-6));
  const Twist2 before = *twist;
  *twist = is_commanded ? approached(limits_, *twist, command, dt) : braked(limits_, *twist, dt);
  // The mean velocity: the one at the end would make the braking distance too short.
  const Twist2 mean{0.5 * (before.vx + twist->vx), 0.5 * (before.vy + twist->vy),
                    0.5 * (before.wz + twist->wz)};
  *pose = integrate(*pose, mean, dt);
  return dt;
}

std::optional<ContactAhead> BrakingGuard::first_contact(const RobotState& state,
                                                        const Twist2& command, const CostGrid& grid,
                                                        const Tracks& tracks) const {
  Pose2 pose = state.pose;
  Twist2 twist = state.twist;
  int allowed = tightness(grid, pose);
  const double end_s = period_s_ + braking_time(limits_, command) + braking_time(limits_, twist);
  double t = 0.0;
  while (t < end_s) {
    t += advance(command, grid, t, &pose, &twist);
    const double speed = outer_speed(checker_.footprint(), twist);
    if (const auto id = hit_track(pose, t, twist, tracks)) return ContactAhead{pose, t, *id};
    const int tight = tightness(grid, pose);
    if (tight > allowed) return ContactAhead{pose, t, -1};
    allowed = tight;
    if (t >= period_s_ && speed == 0.0) break;
  }
  return std::nullopt;
}

}  // namespace trident::nav
