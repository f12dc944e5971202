// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "starts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trident_base/angle.h"
#include "trident_base/random_stream.h"

namespace trident::trajectories {
namespace {

constexpr int kInstants = 25;          // at which undisturbed paths are compared
constexpr double kRoom = 1.1;          // of a swirl, over what fits just so
constexpr double kShort_m = 1e-6;      // a path without direction
constexpr int kCrowd = 8;              // from which on there are three layers instead of two
constexpr double kLayerHeight = 0.8;   // between layers, in separations
constexpr double kRandomSpread = 1.5;  // of a random offset, in separations
constexpr double kNudge = 0.05;        // the same where paths are straight: none run head on

using Offsets = Eigen::Matrix<double, Eigen::Dynamic, 3>;

double crowding_distance(const Problem& problem, std::size_t i, std::size_t j) {
  return 1.5 * separation_of(problem, i, j);
}

bool come_near(const Trajectory& a, const Trajectory& b, double horizon, double distance) {
  for (int k = 0; k <= kInstants; ++k) {
    const double t = horizon * k / kInstants;
    if ((a.at(t).p - b.at(t).p).norm() < distance) return true;
  }
  return false;
}

/// How many others come too near to each robot on undisturbed paths.
std::vector<int> conflicts(const Problem& problem, const std::vector<Trajectory>& paths) {
  std::vector<int> out(paths.size(), 0);
  double horizon = 0.0;
  for (const Trajectory& path : paths) horizon = std::max(horizon, path.duration());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (std::size_t j = i + 1; j < paths.size(); ++j) {
      const bool is_near = must_separate(problem, i, j) &&
                           come_near(paths[i], paths[j], horizon, crowding_distance(problem, i, j));
      out[i] += static_cast<int>(is_near);
      out[j] += static_cast<int>(is_near);
    }
  }
  return out;
}

/// The offset of the free control points that moves a curve's middle by `offset` and its ends not.
Offsets bump(const SplineBasis& basis, const Eigen::Vector3d& offset) {
  const int free = basis.free_points();
  Offsets out(free, 3);
  for (int i = 0; i < free; ++i) {
    const double s = (i + 1.0) / (free + 1.0);
    out.row(i) = 16.0 * s * s * (1.0 - s) * (1.0 - s) * offset.transpose();
  }
  return out;
}

/// Radius of the circle on which `count` robots keep `separation` from their neighbors.
double ring_radius(int count, double separation) {
  return 0.5 * kRoom * separation / std::sin(kPi / std::max(2, count));
}

/// Robots by the direction of their paths: neighbors in that order are put into different layers.
std::vector<int> ranks_by_direction(const std::vector<Trajectory>& paths) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Eigen::Vector3d along = paths[i].at(paths[i].duration()).p - paths[i].at(0.0).p;
    order.emplace_back(std::atan2(along.y(), along.x()), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<int> ranks(paths.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank)
    ranks[order[rank].second] = static_cast<int>(rank);
  return ranks;
}

/// By what the middle of a path is moved to the side: onto a ring that has room for all.
Eigen::Vector2d sideways(const Trajectory& path, int ring, double separation) {
  const Eigen::Vector2d along = path.at(path.duration()).p.head<2>() - path.at(0.0).p.head<2>();
  const double length = along.norm();
  const double reach = std::min(ring_radius(ring, separation), 0.5 * length + separation);
  if (length < kShort_m) return reach * Eigen::Vector2d::UnitY();
  return reach / length * Eigen::Vector2d(-along.y(), along.x());
}

Eigen::Vector3d swirl(Start start, const Problem& problem, std::size_t robot, int others, int rank,
                      const Trajectory& path) {
  const double separation = 2.0 * problem.robots[robot].limits.collision_radius;
  const bool is_layered = start == Start::kSwirlLayers && problem.robots[robot].kind == Kind::kUav;
  const int layers = !is_layered ? 1 : others < kCrowd ? 2 : 3;
  const double side = start == Start::kSwirlRight ? -1.0 : 1.0;
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  out.head<2>() = side * sideways(path, (others + layers) / layers, separation);
  out.z() = kLayerHeight * separation * problem.downwash * (rank % layers - 0.5 * (layers - 1));
  return out;
}

Offsets noise(const SplineBasis& basis, const Robot& robot, std::uint64_t seed, double share) {
  const RandomStream random(seed, "trajectories/" + robot.name);
  const double spread = share * 2.0 * robot.limits.collision_radius;
  Offsets out(basis.free_points(), 3);
  for (int i = 0; i < out.rows(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      out(i, axis) = spread * random.normal(static_cast<std::uint64_t>(i), axis);
  return out;
}

}  // namespace

const char* name_of(Start start) {
  switch (start) {
    case Start::kSwirlLeft:
      return "swirl_left";
    case Start::kSwirlRight:
      return "swirl_right";
    case Start::kSwirlLayers:
      return "swirl_layers";
    case Start::kStraight:
      return "straight";
    case Start::kPriorities:
      return "priorities";
    case Start::kRandom:
      return "random";
  }
  return "";
}

std::vector<double> start_of(Start start, Program& program, const SplineBasis& basis,
                             std::uint64_t seed) {
  const Problem& problem = program.problem();
  Decision& decision = program.decision();
  std::vector<double> x(decision.variables(), 0.0);
  const std::vector<Trajectory> paths = program.trajectories(x.data());
  const std::vector<int> others = conflicts(problem, paths);
  const std::vector<int> ranks = ranks_by_direction(paths);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const bool is_straight = start == Start::kStraight;
    if (start == Start::kRandom || is_straight)
      decision.add_offset(
          i, noise(basis, problem.robots[i], seed, is_straight ? kNudge : kRandomSpread), x.data());
    else if (others[i] > 0)
      decision.add_offset(i, bump(basis, swirl(start, problem, i, others[i], ranks[i], paths[i])),
                          x.data());
  }
  return x;
}

}  // namespace trident::trajectories
