// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "program.h"

#include <algorithm>
#include <utility>

namespace trident::trajectories {
namespace {

std::vector<RobotMotion> undisturbed(Decision& decision, std::size_t robots,
                                     const std::shared_ptr<const SplineBasis>& basis) {
  std::vector<RobotMotion> motions(robots, RobotMotion(basis));
  const std::vector<double> x(decision.variables(), 0.0);
  decision.apply(x.data(), 3, motions);
  return motions;
}

}  // namespace

Program::Program(const Problem& problem, std::shared_ptr<const SplineBasis> basis)
    : problem_(problem),
      basis_(std::move(basis)),
      decision_(problem, basis_),
      motions_(undisturbed(decision_, problem.robots.size(), basis_)),
      cost_(problem, *basis_, motions_, decision_.jerk_scale()),
      constraints_(constraints_of(problem, *basis_)),
      values_(constraints_.size(), 0.0),
      all_(problem.robots.size(), 1),
      some_(problem.robots.size(), 0),
      derivative_(cost_.derivative()) {
  shifts.assign(constraints_.size(), 0.0);
  for (const auto& constraint : constraints_)
    derivative_ = std::max(derivative_, constraint->derivative());
}

void Program::apply(const double* x) {
  decision_.apply(x, derivative_, motions_);
  for (RobotMotion& motion : motions_) motion.clear();
}

double Program::cost(const double* x, double* gradient) {
  apply(x);
  const double cost = cost_.evaluate(motions_);
  if (gradient != nullptr) {
    std::fill(gradient, gradient + decision_.variables(), 0.0);
    decision_.pull_back(motions_, all_, gradient);
  }
  return cost;
}

void Program::constrain(const double* x, double* values, double* gradients) {
  apply(x);
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    Constraint& constraint = *constraints_[i];
    values_[i] = constraint.evaluate(motions_, sharpness) - shifts[i];
    if (gradients == nullptr) continue;
    double* row = gradients + i * decision_.variables();
    std::fill(row, row + decision_.variables(), 0.0);
    for (const std::size_t robot : {constraint.first(), constraint.second()}) {
      motions_[robot].clear();
      some_[robot] = 1;
    }
    constraint.pull_back(1.0, motions_);
    decision_.pull_back(motions_, some_, row);
    for (const std::size_t robot : {constraint.first(), constraint.second()}) some_[robot] = 0;
  }
  if (values != nullptr) std::copy(values_.begin(), values_.end(), values);
}

double Program::lagrangian(const double* x, const double* multipliers, double penalty,
                           double* gradient) {
  apply(x);
  double sum = cost_.evaluate(motions_);
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    values_[i] = constraints_[i]->evaluate(motions_, sharpness) - shifts[i];
    const double force = std::max(0.0, multipliers[i] + penalty * values_[i]);
    sum += (force * force - multipliers[i] * multipliers[i]) / (2.0 * penalty);
    if (force > 0.0) constraints_[i]->pull_back(force, motions_);
  }
  std::fill(gradient, gradient + decision_.variables(), 0.0);
  decision_.pull_back(motions_, all_, gradient);
  return sum;
}

std::vector<Trajectory> Program::trajectories(const double* x) {
  apply(x);
  std::vector<Trajectory> out;
  for (const RobotMotion& motion : motions_)
    out.emplace_back(basis_, motion.points, motion.duration);
  return out;
}

}  // namespace trident::trajectories
