// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sampled_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trident::benchmarks {
namespace {

using namespace trajectories;  // NOLINT: the names of one library

/// Speed below which a heading is held, as a share of the greatest.
constexpr double kFloor = 0.05;

double planar_excess(const Robot& robot, const Instant& at) {
  const Eigen::Vector2d v = at.v.head<2>() - robot.surge.current, a = at.a.head<2>();
  const double floor = kFloor * robot.limits.max_velocity;
  const double speed = std::sqrt(v.squaredNorm() + floor * floor);
  const double rate = std::abs(v.x() * a.y() - v.y() * a.x()) / (speed * speed);
  double worst = rate / robot.limits.max_turn_rate - 1.0;
  if (robot.kind == Kind::kAckermann)
    worst = std::max(worst, rate / speed * robot.limits.min_turning_radius - 1.0);
  if (robot.kind != Kind::kVessel || robot.surge.mass <= 0.0) return worst;
  const double drag = (robot.surge.linear_damping + robot.surge.quadratic_damping * speed) * speed;
  const double force = robot.surge.mass * v.dot(a) / speed + drag;
  return std::max({worst, force / robot.limits.max_thrust - 1.0,
                   -force / robot.limits.max_reverse_thrust - 1.0});
}

}  // namespace

Path path_of(const Trajectory& trajectory) {
  return [&trajectory](double t) {
    const double held = std::clamp(t, 0.0, trajectory.duration());
    const int segment = trajectory.basis().segment_of(held / trajectory.duration());
    return Instant{trajectory.derivative(0, segment, held), trajectory.derivative(1, segment, held),
                   trajectory.derivative(2, segment, held),
                   trajectory.derivative(3, segment, held)};
  };
}

double own_excess(const Problem& problem, std::size_t robot, const Instant& at) {
  const Robot& of = problem.robots[robot];
  double worst = std::max({at.v.norm() / of.limits.max_velocity - 1.0,
                           at.a.norm() / of.limits.max_acceleration - 1.0,
                           at.j.norm() / of.limits.max_jerk - 1.0});
  if (of.kind != Kind::kUav) worst = std::max(worst, planar_excess(of, at));
  if (of.kind == Kind::kUav) worst = std::max(worst, problem.min_height - at.p.z());
  Eigen::Vector3d slope;
  if (problem.obstacles)
    worst = std::max(worst,
                     1.0 - problem.obstacles->distance(at.p, slope) / of.limits.collision_radius);
  return worst;
}

double pair_excess(const Problem& problem, std::size_t first, std::size_t second,
                   const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
  const Robot& a = problem.robots[first];
  const Robot& b = problem.robots[second];
  Eigen::Vector3d delta = p - q;
  if (a.kind == Kind::kUav && b.kind == Kind::kUav) delta.z() /= problem.downwash;
  return 1.0 - delta.norm() / (a.limits.collision_radius + b.limits.collision_radius);
}

double sampled_excess(const Problem& problem, const std::vector<Path>& paths, double duration,
                      double rate) {
  double worst = -std::numeric_limits<double>::infinity();
  const int samples = static_cast<int>(std::ceil(rate * duration));
  std::vector<Instant> at(paths.size());
  for (int k = 0; k <= samples; ++k) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      at[i] = paths[i](duration * k / samples);
      worst = std::max(worst, own_excess(problem, i, at[i]));
      for (std::size_t j = 0; j < i; ++j)
        worst = std::max(worst, pair_excess(problem, i, j, at[i].p, at[j].p));
    }
  }
  return worst;
}

}  // namespace trident::benchmarks
