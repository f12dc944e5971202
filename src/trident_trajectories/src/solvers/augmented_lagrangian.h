// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlopt.hpp>
#include <optional>

#include "solvers/solver.h"

namespace trident::trajectories {

/// The augmented Lagrangian of Birgin and Martinez (2008) around NLopt's L-BFGS. NLopt's own AUGLAG
/// asks for the gradient of each constraint apart, a dense row each, at every step; here the
/// gradient of the sum is computed at once, and constraints that do not push cost nothing.
class AugmentedLagrangian : public Solver {
 public:
  int minimize(Program& program, std::vector<double>& x, int max_evaluations) override;
  double slack_price(const std::vector<double>& values) const override;
  void begin_near() override { begins_near_ = true; }

 private:
  static double objective(unsigned n, const double* x, double* gradient, void* self);
  void begin(Program& program);
  /// Whether it has come to a minimum, rather than to the last evaluation.
  bool descend(std::vector<double>& x, int evaluations, double tolerance);
  void update(double worst);

  Program* program_ = nullptr;
  std::optional<nlopt::opt> lbfgs_;
  std::vector<double> multipliers_;
  double penalty_ = 0.0, worst_ = 0.0;
  int evaluations_ = 0;
  bool begins_near_ = false;
};

}  // namespace trident::trajectories
