// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/control/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trident::nav {
namespace {

constexpr double kStill = 1e-9;  // a velocity below counts as zero [m/s, rad/s]

// The greatest velocity after `duration_s` from `v`: braking as long as it is negative.
double highest(double v, double acceleration, double deceleration, double duration_s) {
  if (v >= 0.0) return v + acceleration * duration_s;
  const double to_rest_s = -v / deceleration;
  if (to_rest_s >= duration_s) return v + deceleration * duration_s;
  return acceleration * (duration_s - to_rest_s);
}

double toward_zero(double v, double change) {
  return std::copysign(std::max(std::fabs(v) - change, 0.0), v);
}

struct AxisLimits {
  double min, max, acceleration, deceleration;
};

void reach(const AxisLimits& axis, double v, double duration_s, double* lo, double* hi) {
  const double up = highest(v, axis.acceleration, axis.deceleration, duration_s);
  const double down = -highest(-v, axis.acceleration, axis.deceleration, duration_s);
  // Outside of the limits of speed the window shrinks to what is nearest to them.
  *lo = std::min(std::max(down, axis.min), up);
  *hi = std::max(std::min(up, axis.max), down);
}

}  // namespace

Pose2 integrate(const Pose2& pose, const Twist2& twist, double duration_s) {
  const double turn = twist.wz * duration_s;
  // Integrals of cos and sin of the heading over the turn, divided by the duration.
  double along = 1.0;
  double across = 0.0;
  if (std::fabs(turn) > 1e-4) {
    along = std::sin(turn) / turn;
    across = (1.0 - std::cos(turn)) / turn;
  } else {
    along = 1.0 - turn * turn / 6.0;
    across = 0.5 * turn;
  }
  const Point2 moved = transform(pose, {(twist.vx * along - twist.vy * across) * duration_s,
                                        (twist.vx * across + twist.vy * along) * duration_s});
  return {moved.x, moved.y, wrap_angle(pose.yaw + turn)};
}

Twist2 TwistWindow::clamp(const Twist2& twist) const {
  return {std::clamp(twist.vx, lo.vx, hi.vx), std::clamp(twist.vy, lo.vy, hi.vy),
          std::clamp(twist.wz, lo.wz, hi.wz)};
}

TwistWindow reachable_window(const MotionLimits& limits, const Twist2& twist, double duration_s) {
  TwistWindow window;
  reach({limits.vx_min, limits.vx_max, limits.ax_max, limits.decel_max}, twist.vx, duration_s,
        &window.lo.vx, &window.hi.vx);
  reach({-limits.vy_max, limits.vy_max, limits.ay_max, limits.ay_max}, twist.vy, duration_s,
        &window.lo.vy, &window.hi.vy);
  reach({-limits.wz_max, limits.wz_max, limits.alpha_max, limits.alpha_max}, twist.wz, duration_s,
        &window.lo.wz, &window.hi.wz);
  return window;
}

Twist2 admissible_twist(const MotionLimits& limits, const TwistWindow& window,
                        const Twist2& wanted) {
  Twist2 twist = wanted;
  const double wz = std::clamp(wanted.wz, window.lo.wz, window.hi.wz);
  if (std::fabs(wz) < std::fabs(wanted.wz) && wz * wanted.wz >= 0.0) {
    const double kept = std::fabs(wz) / std::fabs(wanted.wz);
    twist.vx *= kept;
    twist.vy *= kept;
  }
  twist = window.clamp({twist.vx, twist.vy, wz});
  if (limits.min_turning_radius > 0.0) {
    const double wz_max = std::fabs(twist.vx) / limits.min_turning_radius;
    twist.wz = std::clamp(twist.wz, -wz_max, wz_max);
  }
  return twist;
}

double turning_acceleration(const MotionLimits& limits) {
  const bool is_limited = limits.vy_max <= 0.0 && limits.ay_max > 0.0;
  return is_limited ? limits.ay_max : std::numeric_limits<double>::infinity();
}

Twist2 braked(const MotionLimits& limits, const Twist2& twist, double duration_s) {
  Twist2 next{toward_zero(twist.vx, limits.decel_max * duration_s),
              toward_zero(twist.vy, limits.ay_max * duration_s),
              toward_zero(twist.wz, limits.alpha_max * duration_s)};
  if (limits.min_turning_radius > 0.0) {
    const double wz_max = std::fabs(next.vx) / limits.min_turning_radius;
    next.wz = std::clamp(next.wz, -wz_max, wz_max);
  }
  return next;
}

double braking_time(const MotionLimits& limits, const Twist2& twist) {
  double time_s = std::fabs(twist.vx) > kStill ? std::fabs(twist.vx) / limits.decel_max : 0.0;
  if (std::fabs(twist.vy) > kStill && limits.ay_max > 0.0) {
    time_s = std::max(time_s, std::fabs(twist.vy) / limits.ay_max);
  }
  if (std::fabs(twist.wz) > kStill) {
    time_s = std::max(time_s, std::fabs(twist.wz) / limits.alpha_max);
  }
  return time_s;
}

double stopping_speed(double distance, double deceleration, double reaction_s) {
  if (distance <= 0.0) return 0.0;
  if (std::isinf(deceleration)) return reaction_s > 0.0 ? distance / reaction_s : deceleration;
  // v * reaction + v^2 / (2 deceleration) = distance
  const double lost = deceleration * reaction_s;
  return std::sqrt(lost * lost + 2.0 * deceleration * distance) - lost;
}

bool is_finite(const Pose2& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.yaw);
}

bool is_finite(const Twist2& twist) {
  return std::isfinite(twist.vx) && std::isfinite(twist.vy) && std::isfinite(twist.wz);
}

}  // namespace trident::nav
