// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "terms/constraint.h"

#include <cmath>

#include "terms/distance_constraints.h"
#include "terms/limit_constraints.h"

namespace trident::trajectories {
namespace {

constexpr double kNegligible = -0.4;          // so far within its limit a value has no say
constexpr double kNegligibleExponent = 36.0;  // exp(-36) is below the precision of 1

using Constraints = std::vector<std::unique_ptr<Constraint>>;

void add_norm_limits(const Robot& robot, std::size_t i, int samples, Constraints& out) {
  const Limits& limits = robot.limits;
  const auto add = [&](LimitKind kind, int derivative, double limit) {
    if (std::isfinite(limit))
      out.push_back(std::make_unique<NormLimit>(kind, i, derivative, limit, samples));
  };
  add(LimitKind::kVelocity, 1, limits.max_velocity);
  add(LimitKind::kAcceleration, 2, limits.max_acceleration);
  add(LimitKind::kJerk, 3, limits.max_jerk);
}

void add_turn_limits(const Robot& robot, std::size_t i, int samples, Constraints& out) {
  const Limits& limits = robot.limits;
  if (robot.kind == Kind::kUav) return;
  if (std::isfinite(limits.max_turn_rate))
    out.push_back(std::make_unique<TurnLimit>(LimitKind::kTurnRate, i, 2, limits.max_turn_rate,
                                              robot, samples));
  if (robot.kind == Kind::kAckermann && limits.min_turning_radius > 0.0)
    out.push_back(std::make_unique<TurnLimit>(LimitKind::kTurningRadius, i, 3,
                                              1.0 / limits.min_turning_radius, robot, samples));
}

void add_thrust_limits(const Robot& robot, std::size_t i, int samples, Constraints& out) {
  if (robot.kind != Kind::kVessel || robot.surge.mass <= 0.0) return;
  const auto add = [&](LimitKind kind, double limit) {
    if (std::isfinite(limit))
      out.push_back(std::make_unique<ThrustLimit>(kind, i, limit, robot, samples));
  };
  add(LimitKind::kThrust, robot.limits.max_thrust);
  add(LimitKind::kReverseThrust, robot.limits.max_reverse_thrust);
}

void add_team_limits(const Problem& problem, const SplineBasis& basis, Constraints& out) {
  for (std::size_t i = 0; i < problem.robots.size(); ++i)
    for (std::size_t j = i + 1; j < problem.robots.size(); ++j)
      if (must_separate(problem, i, j))
        out.push_back(std::make_unique<SeparationLimit>(problem, i, j, basis.samples()));
  for (std::size_t i = 0; i < problem.rendezvous.size(); ++i)
    out.push_back(std::make_unique<RendezvousLimit>(problem, i, basis));
  for (std::size_t i = 0; i < problem.order.size(); ++i)
    out.push_back(std::make_unique<OrderLimit>(problem, i));
}

}  // namespace

double SmoothMaximum::compute(double sharpness) {
  Eigen::Index at = 0;
  const double largest = values_.maxCoeff(&at);
  shares_.clear();
  if (!(largest > kNegligible)) {
    shares_.push_back({static_cast<int>(at), 1.0});
    return largest;
  }
  const double least = largest - kNegligibleExponent / sharpness;
  double sum = 0.0;
  for (int k = 0; k < values_.size(); ++k) {
    if (values_[k] < least) continue;
    const double weight = std::exp(sharpness * (values_[k] - largest));
    shares_.push_back({k, weight});
    sum += weight;
  }
  for (Share& share : shares_) share.weight /= sum;
  return largest + std::log(sum) / sharpness;
}

std::vector<std::unique_ptr<Constraint>> constraints_of(const Problem& problem,
                                                        const SplineBasis& basis) {
  Constraints out;
  for (std::size_t i = 0; i < problem.robots.size(); ++i) {
    add_norm_limits(problem.robots[i], i, basis.samples(), out);
    add_turn_limits(problem.robots[i], i, basis.samples(), out);
    add_thrust_limits(problem.robots[i], i, basis.samples(), out);
    if (std::isfinite(problem.min_height) && problem.robots[i].kind == Kind::kUav)
      out.push_back(std::make_unique<HeightLimit>(problem, i, basis.samples()));
    if (problem.obstacles)
      out.push_back(std::make_unique<ObstacleLimit>(problem, i, basis.samples()));
    for (std::size_t j = 0; j < problem.moving.size(); ++j)
      out.push_back(std::make_unique<MovingObstacleLimit>(problem, i, j, basis));
  }
  add_team_limits(problem, basis, out);
  return out;
}

}  // namespace trident::trajectories
