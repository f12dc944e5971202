// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "priorities.h"

#include "search.h"
#include "starts.h"

namespace trident::trajectories {
namespace {

constexpr int kKnots = 40;    // of what the others are to the next one
constexpr int kAttempts = 4;  // straight on, then with noise
constexpr int kEvaluations = 600;

/// A planned robot as the next one sees it.
MovingObstacle obstacle_of(const Problem& problem, std::size_t planned, std::size_t next,
                           const Trajectory& trajectory) {
  std::vector<Prediction::Knot> knots;
  for (int k = 0; k <= kKnots; ++k) {
    const double t = trajectory.duration() * k / kKnots;
    const MotionState state = trajectory.at(t);
    knots.push_back({t, state.p, state.v});
  }
  MovingObstacle out{problem.robots[planned].name, Prediction(std::move(knots)),
                     problem.robots[planned].limits.collision_radius, 1.0};
  out.height_factor = vertical_factor(problem, planned, next);
  return out;
}

/// One robot's own problem, among those that are planned.
Problem alone(const Problem& problem, std::size_t robot, const std::vector<Trajectory>& planned) {
  Problem out;
  out.robots = {problem.robots[robot]};
  out.durations = problem.durations;
  out.places = problem.places;
  out.cost = problem.cost;
  out.obstacles = problem.obstacles;
  out.moving = problem.moving;
  for (std::size_t i = 0; i < planned.size(); ++i)
    if (must_separate(problem, i, robot))
      out.moving.push_back(obstacle_of(problem, i, robot, planned[i]));
  return out;
}

Found plan_alone(const Problem& problem, const std::shared_ptr<const SplineBasis>& basis,
                 OptimizeOptions options) {
  options.max_evaluations = kEvaluations;
  Found best;
  for (int attempt = 0; attempt < kAttempts && !best.is_feasible; ++attempt) {
    options.seed = static_cast<std::uint64_t>(attempt);
    const Start start = attempt == 0 ? Start::kStraight : Start::kRandom;
    Found found = search_from(start, problem, basis, options);
    if (best.x.empty() || found.is_feasible || found.worst < best.worst) best = std::move(found);
  }
  return best;
}

}  // namespace

std::vector<double> priorities_start(const Problem& problem,
                                     const std::shared_ptr<const SplineBasis>& basis,
                                     const OptimizeOptions& options) {
  std::vector<Trajectory> planned;
  std::vector<ControlPoints> points;
  std::vector<double> durations;
  for (const Duration& duration : problem.durations) durations.push_back(duration.value);
  for (std::size_t i = 0; i < problem.robots.size(); ++i) {
    const Problem own = alone(problem, i, planned);
    const Found found = plan_alone(own, basis, options);
    planned.push_back(Program(own, basis).trajectories(found.x.data()).front());
    points.push_back(planned.back().control_points());
    durations[problem.robots[i].duration] = planned.back().duration();
  }
  std::vector<double> x(Decision(problem, basis).variables(), 0.0);
  Decision(problem, basis).fit(points, durations, x.data());
  return x;
}

}  // namespace trident::trajectories
