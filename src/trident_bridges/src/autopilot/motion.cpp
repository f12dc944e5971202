// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/motion.h"

#include <algorithm>
#include <cmath>

namespace trident::bridges {
namespace {

// The cubic from 0 to 1 that starts and ends flat: 3 u^2 - 2 u^3; its steepest slope is 1.5.
constexpr double kSteepest = 1.5;

double smooth(double u) { return u * u * (3.0 - 2.0 * u); }
double smooth_slope(double u) { return 6.0 * u * (1.0 - u); }
double smooth_integral(double u) { return u * u * u * (1.0 - 0.5 * u); }

/// Time of a line's ramp up to a speed, acceleration never above `a`.
double ramp_time(double speed, double a) { return kSteepest * speed / a; }

/// Speed that the limits allow along a direction.
double speed_along(const Eigen::Vector3d& direction, const MotionLimits& limits) {
  const double across = direction.head<2>().norm();
  const double vertical = std::abs(direction.z());
  const double vertical_limit = direction.z() > 0.0 ? limits.up_m_s : limits.down_m_s;
  double speed = 1e9;
  if (across > 1e-9) speed = std::min(speed, limits.horizontal_m_s / across);
  if (vertical > 1e-9) speed = std::min(speed, vertical_limit / vertical);
  return speed;
}

/// Share of a line's ramp, cruise and ramp that is behind after `t`.
struct LinePart {
  double s_m = 0.0;
  double v_m_s = 0.0;
  double a_m_s2 = 0.0;
};

LinePart along_line(double t, double ramp_s, double cruise_s, double speed) {
  if (ramp_s <= 0.0) return {};
  const double total = speed * (ramp_s + cruise_s);
  if (t >= 2.0 * ramp_s + cruise_s) return {total, 0.0, 0.0};
  if (t <= ramp_s) {
    const double u = std::max(t, 0.0) / ramp_s;
    return {speed * ramp_s * smooth_integral(u), speed * smooth(u),
            speed * smooth_slope(u) / ramp_s};
  }
  if (t <= ramp_s + cruise_s) return {speed * (0.5 * ramp_s + t - ramp_s), speed, 0.0};
  const double u = (2.0 * ramp_s + cruise_s - t) / ramp_s;
  return {total - speed * ramp_s * smooth_integral(u), speed * smooth(u),
          -speed * smooth_slope(u) / ramp_s};
}

}  // namespace

void Motion::stop_at(const Eigen::Vector3d& p_m, SimTime now) {
  *this = Motion();
  begin_ = now;
  p_begin_ = p_m;
}

void Motion::follow(const Reference& reference, SimTime now) {
  stop_at(reference.p_m, now);
  v_begin_ = v_end_ = reference.v_m_s;
}

void Motion::set_velocity(const Eigen::Vector3d& v_m_s, const MotionLimits& limits, SimTime now) {
  const Reference present = at(now);
  stop_at(present.p_m, now);
  v_begin_ = present.v_m_s;
  v_end_ = v_m_s;
  change_s_ = (v_end_ - v_begin_).norm() / limits.a_m_s2;
}

void Motion::brake(const MotionLimits& limits, SimTime now) {
  set_velocity(Eigen::Vector3d::Zero(), limits, now);
}

void Motion::go_to(const Eigen::Vector3d& goal_m, const MotionLimits& limits, SimTime now) {
  brake(limits, now);
  const Eigen::Vector3d line = goal_m - goal(now);
  const double length = line.norm();
  if (length < 1e-9) return;
  line_ = line / length;
  // A ramp of the cubic covers half of speed times its time: the two alone are the whole line.
  line_m_s_ = std::min(speed_along(line_, limits), std::sqrt(length * limits.a_m_s2 / kSteepest));
  ramp_s_ = ramp_time(line_m_s_, limits.a_m_s2);
  cruise_s_ = std::max(0.0, length / line_m_s_ - ramp_s_);
}

Reference Motion::at(SimTime now) const {
  const double t = std::max(0.0, (now - begin_).seconds());
  Reference result;
  const double u = change_s_ > 0.0 ? std::min(1.0, t / change_s_) : 1.0;
  const Eigen::Vector3d change = v_end_ - v_begin_;
  result.v_m_s = v_begin_ + change * u;
  const double within = std::min(t, change_s_);
  result.p_m =
      p_begin_ + v_begin_ * within + change * (0.5 * change_s_ * u * u) + v_end_ * (t - within);
  if (change_s_ > 0.0 && u < 1.0) result.a_m_s2 = change / change_s_;
  const LinePart part = along_line(t, ramp_s_, cruise_s_, line_m_s_);
  result.p_m += line_ * part.s_m;
  result.v_m_s += line_ * part.v_m_s;
  result.a_m_s2 += line_ * part.a_m_s2;
  return result;
}

bool Motion::is_settled(SimTime now) const {
  return (now - begin_).seconds() >= std::max(change_s_, 2.0 * ramp_s_ + cruise_s_);
}

bool Motion::is_at_rest(SimTime now) const { return v_end_.norm() <= 1e-9 && is_settled(now); }

Eigen::Vector3d Motion::goal(SimTime now) const {
  if (v_end_.norm() > 1e-9) return at(now).p_m;
  return p_begin_ + 0.5 * change_s_ * v_begin_ + line_ * (line_m_s_ * (ramp_s_ + cruise_s_));
}

}  // namespace trident::bridges
