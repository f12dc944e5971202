// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/curves/motion_curve.h"

#include <limits>

namespace trident::nav {
namespace {

constexpr double kNothing = 1e-9;

/// In [0, 2 pi); what rounding made a full turn is 0.
double full_turn(double angle) {
  const double turns = angle - 2.0 * kPi * std::floor(angle / (2.0 * kPi));
  return turns > 2.0 * kPi - kNothing ? 0.0 : turns;
}

/// A goal from the start's point of view, in turning radii; `mirrored`: left is right.
struct Relative {
  double x, y, yaw, sin, cos;
};

Relative relative_to(const Pose2& from, const Pose2& to, double radius) {
  const double c = std::cos(from.yaw), s = std::sin(from.yaw);
  const double dx = (to.x - from.x) / radius, dy = (to.y - from.y) / radius;
  const double yaw = wrap_angle(to.yaw - from.yaw);
  return {c * dx + s * dy, c * dy - s * dx, yaw, std::sin(yaw), std::cos(yaw)};
}

Relative mirrored(const Relative& goal) {
  return {goal.x, -goal.y, -goal.yaw, -goal.sin, goal.cos};
}

/// The shortest of the words that were tried: lengths, turns of each segment.
struct Best {
  double total = std::numeric_limits<double>::infinity();
  int size = 0;
  std::array<CurveSegment, MotionCurve::kMaxSegments> segments{};

  MotionCurve curve(double radius) const {
    MotionCurve result(radius);
    for (int i = 0; i < size; ++i) result.add(segments[i].turn, segments[i].length);
    return result;
  }
};

/// The three words of Dubins curves that begin to the left; `side` -1: to the right, for a mirrored
/// goal. From the centers of the circles at both ends.
class DubinsWords {
 public:
  explicit DubinsWords(Best& best) : best_(best) {}

  void try_all(const Relative& goal, int side) {
    side_ = side;
    // Centers of the left circles of both ends, from the first one.
    const double same_x = goal.x - goal.sin, same_y = goal.y + goal.cos - 1.0;
    const double gap = std::hypot(same_x, same_y);
    const double to_same = std::atan2(same_y, same_x);
    offer(0, 1, full_turn(to_same), gap, full_turn(goal.yaw - to_same));
    try_crossing(goal);
    if (gap <= 4.0) try_three_arcs(goal, gap, to_same);
  }

 private:
  // To the left, straight, to the right.
  void try_crossing(const Relative& goal) {
    const double x = goal.x + goal.sin, y = goal.y - goal.cos - 1.0;
    const double gap2 = x * x + y * y;
    if (gap2 < 4.0) return;
    const double straight = std::sqrt(gap2 - 4.0);
    const double heading = std::atan2(y, x) + std::atan2(2.0, straight);
    offer(0, -1, full_turn(heading), straight, full_turn(heading - goal.yaw));
  }

  // Left, right, left: the middle circle touches both others, on either side.
  void try_three_arcs(const Relative& goal, double gap, double to_same) {
    const double off = std::acos(gap / 4.0);
    for (const double angle : {off, -off}) {
      const double first = to_same + angle + kPi / 2.0;
      const double second = to_same - angle + 1.5 * kPi;
      offer(-1, 1, full_turn(first), full_turn(first - second), full_turn(goal.yaw - second));
    }
  }

  void offer(int middle, int last, double a, double b, double c) {
    if (a + b + c >= best_.total) return;
    best_.total = a + b + c;
    best_.size = 3;
    best_.segments[0] = {side_, a};
    best_.segments[1] = {side_ * middle, b};
    best_.segments[2] = {side_ * last, c};
  }

  Best& best_;
  int side_ = 1;
};

/// The words of Reeds and Shepp, in the symbols of section 8 of their paper: t, u, v are lengths of
/// segments, negative ones are driven backwards.
class ReedsSheppWords {
 public:
  explicit ReedsSheppWords(Best& best) : best_(best) {}

  void try_all(const Relative& goal) {
    const double back_x = goal.x * goal.cos + goal.y * goal.sin;
    const double back_y = goal.x * goal.sin - goal.y * goal.cos;
    for (const int gear : {1, -1}) {
      for (const int side : {1, -1}) {
        gear_ = gear;
        side_ = side;
        reversed_ = false;
        try_words(flipped(goal, goal.x, goal.y), true);
        reversed_ = true;
        try_words(flipped(goal, back_x, back_y), false);
      }
    }
  }

 private:
  // The goal with time flipped (gear -1) and reflected (side -1).
  Relative flipped(const Relative& goal, double x, double y) const {
    const double sign = gear_ * side_;
    return {gear_ * x, side_ * y, sign * goal.yaw, sign * goal.sin, goal.cos};
  }

  void try_words(const Relative& g, bool all) {
    const double xi = g.x - g.sin, eta = g.y - 1.0 + g.cos;
    const double rho = std::hypot(xi, eta);
    const double cross_xi = g.x + g.sin, cross_eta = g.y - 1.0 - g.cos;
    const double cross_rho = std::hypot(cross_xi, cross_eta);
    if (rho < 4.0 + kNothing) three_arcs(g, rho, std::atan2(eta, xi));
    if (rho >= 2.0) cusp_same(g, rho, std::atan2(eta, xi));
    if (cross_rho >= 2.0) cusp_other(g, cross_rho, std::atan2(cross_xi, -cross_eta));
    if (!all) return;
    offer({1, 0, 1}, {mod(std::atan2(eta, xi)), rho, mod(g.yaw - std::atan2(eta, xi))}, 3);
    if (cross_rho >= 2.0) crossing(g, cross_rho, std::atan2(cross_eta, cross_xi));
    four_arcs(g, cross_xi, cross_eta, cross_rho);
    if (cross_rho >= 4.0 - kNothing) double_cusp(g, cross_xi, cross_eta, cross_rho);
  }

  // 8.2: L+ S+ R+.
  void crossing(const Relative& g, double rho, double theta) {
    const double u = std::sqrt(std::max(0.0, rho * rho - 4.0));
    const double t = mod(theta + std::atan2(2.0, u));
    offer({1, 0, -1}, {t, u, mod(t - g.yaw)}, 3);
  }

  // 8.3, 8.4: L+ R- L+ and L+ R- L-.
  void three_arcs(const Relative& g, double rho, double theta) {
    const double u = -2.0 * std::asin(std::min(1.0, rho / 4.0));
    const double t = mod(theta + u / 2.0 + kPi);
    if (t < -kNothing) return;
    offer({1, -1, 1}, {t, u, mod(g.yaw - t + u)}, 3);
  }

  // 8.7, 8.8: L+ R+ L- R- and L+ R- L- R+, both middle arcs of equal length.
  void four_arcs(const Relative& g, double xi, double eta, double cross_rho) {
    const double inner = (2.0 + cross_rho) / 4.0;
    if (inner <= 1.0) {
      const double u = std::acos(inner);
      const auto [t, v] = outer_arcs(u, -u, xi, eta, g.yaw);
      if (t >= -kNothing && v <= kNothing) offer({1, -1, 1, -1}, {t, u, -u, v}, 4);
    }
    const double outer = (20.0 - cross_rho * cross_rho) / 16.0;
    if (outer < 0.0 || outer > 1.0) return;
    const double u = -std::acos(outer);
    const auto [t, v] = outer_arcs(u, u, xi, eta, g.yaw);
    if (t >= -kNothing && v >= -kNothing) offer({1, -1, 1, -1}, {t, u, u, v}, 4);
  }

  // The first and the last arc around two arcs of lengths u and v (the paper's tau and omega).
  static std::array<double, 2> outer_arcs(double u, double v, double xi, double eta, double yaw) {
    const double delta = mod(u - v);
    const double a = std::sin(u) - std::sin(delta);
    const double b = std::cos(u) - std::cos(delta) - 1.0;
    const double turn = std::atan2(eta * a - xi * b, xi * a + eta * b);
    const double sign = 2.0 * (std::cos(delta) - std::cos(v) - std::cos(u)) + 3.0;
    const double tau = mod(sign < 0.0 ? turn + kPi : turn);
    return {tau, mod(tau - u + v - yaw)};
  }

  // 8.9: L+ R(-pi/2) S- L-.
  void cusp_same(const Relative& g, double rho, double theta) {
    const double r = std::sqrt(std::max(0.0, rho * rho - 4.0));
    const double t = mod(theta + std::atan2(r, -2.0));
    const double v = mod(g.yaw - kPi / 2.0 - t);
    if (t < -kNothing || v > kNothing) return;
    offer({1, -1, 0, 1}, {t, -kPi / 2.0, 2.0 - r, v}, 4, 2.0 - r <= kNothing);
  }

  // 8.10: L+ R(-pi/2) S- R-.
  void cusp_other(const Relative& g, double rho, double theta) {
    const double t = mod(theta);
    const double v = mod(t + kPi / 2.0 - g.yaw);
    if (t < -kNothing || v > kNothing) return;
    offer({1, -1, 0, -1}, {t, -kPi / 2.0, 2.0 - rho, v}, 4);
  }

  // 8.11: L+ R(-pi/2) S- L(-pi/2) R+.
  void double_cusp(const Relative& g, double xi, double eta, double rho) {
    const double u = 4.0 - std::sqrt(std::max(0.0, rho * rho - 4.0));
    if (u > kNothing) return;
    const double t = mod(std::atan2((4.0 - u) * xi - 2.0 * eta, -2.0 * xi + (u - 4.0) * eta));
    const double v = mod(t - g.yaw);
    if (t < -kNothing || v < -kNothing) return;
    offer({1, -1, 0, 1, -1}, {t, -kPi / 2.0, u, -kPi / 2.0, v}, 5);
  }

  // In (-pi, pi].
  static double mod(double angle) { return wrap_angle(angle); }

  void offer(const std::array<int, 5>& turns, const std::array<double, 5>& lengths, int size,
             bool valid = true) {
    double total = 0.0;
    for (int i = 0; i < size; ++i) total += std::abs(lengths[i]);
    if (!valid || total >= best_.total - kNothing) return;
    best_.total = total;
    best_.size = size;
    for (int i = 0; i < size; ++i) {
      const int k = reversed_ ? size - 1 - i : i;
      best_.segments[i] = {side_ * turns[k], gear_ * lengths[k]};
    }
  }

  Best& best_;
  int gear_ = 1;
  int side_ = 1;
  bool reversed_ = false;
};

}  // namespace

void MotionCurve::add(int turn, double length) {
  if (std::abs(length) < kNothing) return;
  segments_[static_cast<std::size_t>(size_)] = {turn, length};
  sum_ += std::abs(length);
  ++size_;
}

Pose2 pose_along(const Pose2& from, const CurveSegment& segment, double radius, double length) {
  const double s = std::copysign(length, segment.length);
  if (segment.turn == 0) {
    return {from.x + s * std::cos(from.yaw), from.y + s * std::sin(from.yaw), from.yaw};
  }
  const double signed_radius = segment.turn * radius;
  const double yaw = from.yaw + s / signed_radius;
  return {from.x + signed_radius * (std::sin(yaw) - std::sin(from.yaw)),
          from.y - signed_radius * (std::cos(yaw) - std::cos(from.yaw)), yaw};
}

MotionCurve dubins_curve(const Pose2& from, const Pose2& to, double radius) {
  const Relative goal = relative_to(from, to, radius);
  Best best;
  DubinsWords words(best);
  words.try_all(goal, 1);
  words.try_all(mirrored(goal), -1);
  return best.curve(radius);
}

MotionCurve reeds_shepp_curve(const Pose2& from, const Pose2& to, double radius) {
  const Relative goal = relative_to(from, to, radius);
  Best best;
  ReedsSheppWords words(best);
  words.try_all(goal);
  return best.curve(radius);
}

}  // namespace trident::nav
