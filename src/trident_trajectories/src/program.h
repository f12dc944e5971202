// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "decision.h"
#include "terms/constraint.h"
#include "terms/cost.h"
#include "trident_trajectories/trajectory.h"

namespace trident::trajectories {

/// A problem as optimizers see it: minimize cost(x), constraint(x) - shift <= 0. A shift moves the
/// smooth maximum over samples to the true maximum between them. Functions do not allocate.
class Program {
 public:
  /// The problem must be valid and outlive this.
  Program(const Problem& problem, std::shared_ptr<const SplineBasis> basis);

  const Problem& problem() const { return problem_; }
  Decision& decision() { return decision_; }
  std::size_t constraints() const { return constraints_.size(); }  ///< number
  const Constraint& constraint(std::size_t i) const { return *constraints_[i]; }

  double sharpness = 40.0;     ///< of smooth maxima
  std::vector<double> shifts;  ///< one for each constraint

  /// The cost; its gradient is set where that is not null.
  double cost(const double* x, double* gradient);

  /// Sets constraint(x) - shift; the gradients, a row each, where that is not null.
  void constrain(const double* x, double* values, double* gradients);

  /// The augmented Lagrangian for inequalities (Birgin, Martinez, 2008, equation 2):
  /// cost + sum(max(0, multiplier + penalty g)^2 - multiplier^2) / (2 penalty), and its gradient.
  double lagrangian(const double* x, const double* multipliers, double penalty, double* gradient);

  /// Values of the constraints of the call before.
  const std::vector<double>& values() const { return values_; }

  /// The team's path for x.
  std::vector<Trajectory> trajectories(const double* x);

 private:
  void apply(const double* x);

  const Problem& problem_;
  std::shared_ptr<const SplineBasis> basis_;
  Decision decision_;
  std::vector<RobotMotion> motions_;
  Cost cost_;
  std::vector<std::unique_ptr<Constraint>> constraints_;
  std::vector<double> values_;
  std::vector<char> all_, some_;  ///< robots whose gradients are asked for
  int derivative_ = 0;
};

}  // namespace trident::trajectories
