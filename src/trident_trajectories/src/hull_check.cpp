// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "hull_check.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace trident::trajectories {
namespace {

constexpr double kPeakTolerance = 1e-5;   // of g
constexpr int kMaxObstacleParts = 20000;  // of one piece that are compared with obstacles
constexpr double kShortest_s = 1e-3;      // that obstacles are looked at
constexpr int kThrustSamples = 50;        // per segment
constexpr double kNothing = -std::numeric_limits<double>::infinity();

/// Bernstein coefficients of a polynomial by its derivatives at the begin of an interval of length
/// h: c_i = sum over k <= i of binomial(i, k) (n - k)! / n! h^k derivative_k.
template <class Derivative>
std::array<Bernstein, 3> from_derivatives(double h, Derivative derivative) {
  std::array<Bernstein, 3> out;
  std::array<Eigen::Vector3d, kOrder> differences;
  double scale = 1.0;  // (n - k)! / n! h^k
  for (int k = 0; k < kOrder; ++k) {
    differences[k] = scale * derivative(k);
    if (k < kDegree) scale *= h / (kDegree - k);
  }
  for (int axis = 0; axis < 3; ++axis) {
    out[axis].degree = kDegree;
    for (int i = 0; i < kOrder; ++i) {
      double binomial = 1.0, sum = 0.0;
      for (int k = 0; k <= i; ++k) {
        sum += binomial * differences[k][axis];
        binomial *= static_cast<double>(i - k) / (k + 1);
      }
      out[axis].c[i] = sum;
    }
  }
  return out;
}

Bernstein constant(double value) {
  Bernstein out;
  out.c[0] = value;
  return out;
}

void keep_worse(const Greatest& found, double begin, double end, Peak& peak) {
  if (found.value > peak.value) peak = {found.value, begin + found.u * (end - begin)};
}

/// The same for the greatest of top / bottom.
void look_for_worse(const Bernstein& top, const Bernstein& bottom, double begin, double end,
                    Peak& peak) {
  const double floor = std::max(kPeakFloor, peak.value);
  keep_worse(greatest_ratio(top, bottom, floor, kPeakTolerance), begin, end, peak);
}

}  // namespace

HullCheck::HullCheck(const Problem& problem, const std::vector<Trajectory>& trajectories)
    : problem_(problem), trajectories_(trajectories) {
  for (const Trajectory& trajectory : trajectories_) {
    std::vector<Piece>& pieces = pieces_.emplace_back();
    const int segments = trajectory.basis().segments();
    for (int segment = 0; segment < segments; ++segment) {
      const double begin = trajectory.duration() * segment / segments;
      const double end = trajectory.duration() * (segment + 1) / segments;
      pieces.push_back({begin, end, axes_of(trajectory, begin, end)});
    }
  }
}

HullCheck::Axes HullCheck::axes_of(const Trajectory& trajectory, double begin, double end) const {
  const double middle = 0.5 * (begin + end);
  const int segment = trajectory.basis().segment_of(middle / trajectory.duration());
  if (middle < trajectory.duration())
    return from_derivatives(
        end - begin, [&](int order) { return trajectory.derivative(order, segment, begin); });
  const MotionState state = trajectory.at(begin);
  return from_derivatives(end - begin, [&](int order) -> Eigen::Vector3d {
    if (order == 0) return state.p;
    return order == 1 ? trajectory.at(end).v : Eigen::Vector3d::Zero();
  });
}

HullCheck::Axes HullCheck::axes_of(const Prediction& prediction, double begin, double end) const {
  const MotionState state = prediction.at(begin);
  const Eigen::Vector3d jerk = prediction.jerk(begin);
  return from_derivatives(end - begin, [&](int order) -> Eigen::Vector3d {
    const std::array<Eigen::Vector3d, 4> all = {state.p, state.v, state.a, jerk};
    return order < 4 ? all[order] : Eigen::Vector3d::Zero();
  });
}

std::vector<double> HullCheck::breaks(const Trajectory& a, const Trajectory& b) const {
  std::vector<double> out;
  for (const Trajectory* one : {&a, &b})
    for (int i = 0; i <= one->basis().segments(); ++i)
      out.push_back(one->duration() * i / one->basis().segments());
  std::sort(out.begin(), out.end());
  const auto same = [](double x, double y) { return y - x < 1e-9; };
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
  return out;
}

Peak HullCheck::separation(std::size_t first, std::size_t second) const {
  const Trajectory& a = trajectories_[first];
  const Trajectory& b = trajectories_[second];
  const double scale = std::pow(separation_of(problem_, first, second), -2);
  const double vertical = scale * std::pow(vertical_factor(problem_, first, second), -2);
  Peak peak{kNothing, 0.0};
  const auto look = [&](const Axes& p, const Axes& q, double begin, double end) {
    Bernstein square = constant(0.0);
    double clear = 0.0;  // of the boxes about both hulls
    for (int axis = 0; axis < 3; ++axis) {
      const Bernstein delta = p[axis] - q[axis];
      const double gap = std::max({0.0, delta.least(), -delta.greatest()});
      const double weight = axis == 2 ? vertical : scale;
      clear += weight * gap * gap;
      square = square + weight * (delta * delta);
    }
    if (1.0 - clear < kPeakFloor) return keep_worse({1.0 - clear, 0.0}, begin, end, peak);
    look_for_worse((-1.0) * square + 1.0, constant(1.0), begin, end, peak);
  };
  if (a.duration() == b.duration()) {
    for (std::size_t i = 0; i < pieces_[first].size(); ++i)
      look(pieces_[first][i].p, pieces_[second][i].p, pieces_[first][i].begin,
           pieces_[first][i].end);
    return peak;
  }
  const std::vector<double> times = breaks(a, b);
  for (std::size_t i = 0; i + 1 < times.size(); ++i)
    look(axes_of(a, times[i], times[i + 1]), axes_of(b, times[i], times[i + 1]), times[i],
         times[i + 1]);
  return peak;
}

Peak HullCheck::moving(std::size_t robot, const MovingObstacle& obstacle) const {
  const Trajectory& trajectory = trajectories_[robot];
  std::vector<double> times = breaks(trajectory, trajectory);
  for (const double t : obstacle.prediction.times())
    if (t > 0.0 && t < trajectory.duration()) times.push_back(t);
  std::sort(times.begin(), times.end());
  const double scale =
      std::pow(obstacle.radius + problem_.robots[robot].limits.collision_radius, -2);
  Peak peak{kNothing, 0.0};
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const Axes p = axes_of(trajectory, times[i], times[i + 1]);
    const Axes q = axes_of(obstacle.prediction, times[i], times[i + 1]);
    Bernstein square = constant(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      const Bernstein delta = p[axis] - q[axis];
      const double factor = axis == 2 ? std::pow(obstacle.height_factor, -2) : 1.0;
      square = square + (factor * scale) * (delta * delta);
    }
    look_for_worse((-1.0) * square + 1.0, constant(1.0), times[i], times[i + 1], peak);
  }
  return peak;
}

Peak HullCheck::norm(std::size_t robot, int derivative, double limit) const {
  Peak peak{kNothing, 0.0};
  for (const Piece& piece : pieces_[robot]) {
    const double scale = std::pow(piece.end - piece.begin, -derivative) / limit;
    Bernstein square = constant(-1.0);
    for (Bernstein axis : piece.p) {
      for (int i = 0; i < derivative; ++i) axis = axis.derivative();
      square = square + (scale * scale) * (axis * axis);
    }
    look_for_worse(square, constant(1.0), piece.begin, piece.end, peak);
  }
  return peak;
}

Peak HullCheck::turn(std::size_t robot, LimitKind kind) const {
  const Robot& of = problem_.robots[robot];
  const bool is_rate = kind == LimitKind::kTurnRate;
  const double limit = is_rate ? of.limits.max_turn_rate : 1.0 / of.limits.min_turning_radius;
  Peak peak{kNothing, 0.0};
  for (const Piece& piece : pieces_[robot]) {
    const double rate = 1.0 / (piece.end - piece.begin);
    const Bernstein vx = rate * piece.p[0].derivative() + -of.surge.current.x();
    const Bernstein vy = rate * piece.p[1].derivative() + -of.surge.current.y();
    const Bernstein ax = rate * vx.derivative(), ay = rate * vy.derivative();
    const Bernstein cross = (1.0 / limit) * (vx * ay - vy * ax);
    const Bernstein square = vx * vx + vy * vy + std::pow(speed_floor(of.limits), 2);
    const Bernstein bottom = is_rate ? square * square : square * square * square;
    look_for_worse(cross * cross - bottom, bottom, piece.begin, piece.end, peak);
  }
  return peak;
}

Peak HullCheck::thrust(std::size_t robot, double factor) const {
  const Robot& of = problem_.robots[robot];
  const Trajectory& trajectory = trajectories_[robot];
  const int samples = kThrustSamples * trajectory.basis().segments();
  Peak peak{kNothing, 0.0};
  for (int k = 0; k <= samples; ++k) {
    const double t = trajectory.duration() * k / samples;
    const MotionState state = trajectory.at(std::min(t, trajectory.duration() * (1.0 - 1e-12)));
    const Eigen::Vector2d v = state.v.head<2>() - of.surge.current;
    const double u = std::hypot(v.norm(), speed_floor(of.limits));
    const double force = of.surge.mass * state.a.head<2>().dot(v) / u +
                         (of.surge.linear_damping + of.surge.quadratic_damping * u) * u;
    keep_worse({factor * force - 1.0, 0.0}, t, t, peak);
  }
  return peak;
}

Peak HullCheck::height(std::size_t robot) const {
  Peak peak{kNothing, 0.0};
  for (const Piece& piece : pieces_[robot])
    look_for_worse((-1.0) * piece.p[2] + problem_.min_height, constant(1.0), piece.begin, piece.end,
                   peak);
  return peak;
}

Peak HullCheck::obstacle(std::size_t robot) const {
  const double radius = problem_.robots[robot].limits.collision_radius;
  Peak peak{kNothing, 0.0};
  Eigen::Vector3d slope;
  for (const Piece& whole : pieces_[robot]) {
    std::vector<Piece> parts = {whole};
    for (int looked_at = 0; !parts.empty() && looked_at < kMaxObstacleParts; ++looked_at) {
      const Piece part = parts.back();
      parts.pop_back();
      Piece left{part.begin, 0.5 * (part.begin + part.end), {}};
      Piece right{left.end, part.end, {}};
      Eigen::Vector3d middle, half;  // of the box about the hull
      for (int axis = 0; axis < 3; ++axis) {
        part.p[axis].split(left.p[axis], right.p[axis]);
        middle[axis] = right.p[axis].at_begin();
        half[axis] =
            std::max(part.p[axis].greatest() - middle[axis], middle[axis] - part.p[axis].least());
      }
      const double distance = problem_.obstacles->distance(middle, slope);
      keep_worse({1.0 - distance / radius, 0.0}, left.end, left.end, peak);
      const double bound = 1.0 - (distance - half.norm()) / radius;
      if (bound <= std::max(peak.value + kPeakTolerance, kPeakFloor)) continue;
      if (part.end - part.begin < kShortest_s) continue;
      parts.push_back(left);
      parts.push_back(right);
    }
  }
  return peak;
}

Peak HullCheck::rendezvous(const Rendezvous& rendezvous) const {
  const Trajectory& first = trajectories_[rendezvous.first];
  const double t = rendezvous.fraction * first.duration();
  const Eigen::Vector3d delta = first.at(t).p - trajectories_[rendezvous.second].at(t).p;
  return {(delta - rendezvous.offset).norm() - rendezvous.tolerance, t};
}

Peak HullCheck::order(const ArrivalOrder& order) const {
  const double earlier = trajectories_[order.earlier].duration();
  const double later = trajectories_[order.later].duration();
  const double scale = problem_.durations[problem_.robots[order.later].duration].value;
  return {(earlier + order.gap - later) / scale, later};
}

Peak HullCheck::peak(const Constraint& constraint) const {
  const std::size_t robot = constraint.first();
  const Limits& limits = problem_.robots[robot].limits;
  switch (constraint.limit()) {
    case LimitKind::kVelocity:
      return norm(robot, 1, limits.max_velocity);
    case LimitKind::kAcceleration:
      return norm(robot, 2, limits.max_acceleration);
    case LimitKind::kJerk:
      return norm(robot, 3, limits.max_jerk);
    case LimitKind::kTurnRate:
    case LimitKind::kTurningRadius:
      return turn(robot, constraint.limit());
    case LimitKind::kThrust:
      return thrust(robot, 1.0 / limits.max_thrust);
    case LimitKind::kReverseThrust:
      return thrust(robot, -1.0 / limits.max_reverse_thrust);
    case LimitKind::kHeight:
      return height(robot);
    case LimitKind::kSeparation:
      return separation(robot, constraint.second());
    case LimitKind::kObstacle:
      return obstacle(robot);
    case LimitKind::kMovingObstacle:
      return moving(robot, problem_.moving[constraint.item()]);
    case LimitKind::kRendezvous:
      return rendezvous(problem_.rendezvous[constraint.item()]);
    case LimitKind::kOrder:
      return order(problem_.order[constraint.item()]);
  }
  return {};
}

}  // namespace trident::trajectories
