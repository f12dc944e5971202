// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlopt.hpp>

#include "solvers/solver.h"

namespace trident::trajectories {

/// One of NLopt's methods that take inequalities: MMA and CCSAQ (Svanberg, 2002), SLSQP (Kraft,
/// 1994).
class NloptSolver : public Solver {
 public:
  explicit NloptSolver(nlopt::algorithm algorithm) : algorithm_(algorithm) {}
  int minimize(Program& program, std::vector<double>& x, int max_evaluations) override;

 private:
  nlopt::algorithm algorithm_;
};

}  // namespace trident::trajectories
