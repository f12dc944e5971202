// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "priority_planner.h"

#include <array>
#include <cmath>

namespace trident::benchmarks {
namespace {

using namespace trajectories;  // NOLINT: the names of one library

constexpr std::array kDelays = {0.0, 0.15, 0.3};                      // of the duration
constexpr std::array kBows = {0.0, 2.0, -2.0, 4.0, -4.0, 7.0, -7.0};  // to the left [m]
constexpr std::array kClimbs = {0.0, 2.0, -1.5, 4.0};                 // [m]
constexpr double kRough_Hz = 20.0, kFine_Hz = 1000.0;

/// A polynomial of u by ascending powers, and its derivatives.
template <std::size_t n>
std::array<double, 4> derivatives(std::array<double, n> c, double u) {
  std::array<double, 4> out = {};
  for (double& value : out) {
    for (std::size_t i = n; i-- > 0;) value = value * u + c[i];
    for (std::size_t i = 1; i < n; ++i) c[i - 1] = static_cast<double>(i) * c[i];
    c[n - 1] = 0.0;
  }
  return out;
}

/// From rest to rest between `begin` and `end`, bowed by `bow` in its middle.
Path bowed_path(const Robot& robot, double begin, double end, const Eigen::Vector3d& bow) {
  const Eigen::Vector3d from = robot.start.p, delta = robot.goal.state.p - robot.start.p;
  return [=](double t) {
    const double h = end - begin, u = std::fmin(1.0, std::fmax(0.0, (t - begin) / h));
    const auto along = derivatives(std::array{0.0, 0.0, 0.0, 10.0, -15.0, 6.0}, u);
    const auto side = derivatives(std::array{0.0, 0.0, 0.0, 64.0, -192.0, 192.0, -64.0}, u);
    const bool is_moving = t >= begin && t <= end;
    const double rate = is_moving ? 1.0 / h : 0.0;
    return Instant{from + along[0] * delta + side[0] * bow,
                   rate * (along[1] * delta + side[1] * bow),
                   rate * rate * (along[2] * delta + side[2] * bow),
                   rate * rate * rate * (along[3] * delta + side[3] * bow)};
  };
}

bool is_clear(const Problem& problem, std::size_t robot, const Path& path,
              const std::vector<Path>& others, double rate) {
  const double duration = problem.durations[0].value;
  const int samples = static_cast<int>(std::ceil(rate * duration));
  for (int k = 0; k <= samples; ++k) {
    const double t = duration * k / samples;
    const Instant at = path(t);
    if (own_excess(problem, robot, at) > 0.0) return false;
    for (std::size_t i = 0; i < others.size(); ++i)
      if (pair_excess(problem, robot, i, at.p, others[i](t).p) > 0.0) return false;
  }
  return true;
}

std::optional<Path> first_clear_path(const Problem& problem, std::size_t robot,
                                     const std::vector<Path>& others) {
  const Robot& of = problem.robots[robot];
  const double duration = problem.durations[0].value;
  const Eigen::Vector3d delta = of.goal.state.p - of.start.p;
  const Eigen::Vector3d left = Eigen::Vector3d(-delta.y(), delta.x(), 0.0).normalized();
  for (const double delay : kDelays)
    for (const double climb : kClimbs)
      for (const double bow : kBows) {
        if (climb != 0.0 && of.kind != Kind::kUav) continue;
        const Path candidate = bowed_path(of, delay * duration, duration,
                                          bow * left + Eigen::Vector3d(0.0, 0.0, climb));
        if (is_clear(problem, robot, candidate, others, kRough_Hz) &&
            is_clear(problem, robot, candidate, others, kFine_Hz))
          return candidate;
      }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<Path>> plan_by_priorities(const Problem& problem) {
  std::vector<Path> paths;
  for (std::size_t i = 0; i < problem.robots.size(); ++i) {
    const std::optional<Path> path = first_clear_path(problem, i, paths);
    if (!path) return std::nullopt;
    paths.push_back(*path);
  }
  return paths;
}

}  // namespace trident::benchmarks
