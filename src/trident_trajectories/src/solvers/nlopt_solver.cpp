// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "solvers/nlopt_solver.h"

#include <algorithm>

namespace trident::trajectories {
namespace {

constexpr double kRelativeChange = 1e-5;  // of the cost, at which it ends
constexpr double kTolerance = 1e-4;       // of each constraint

double cost(unsigned /*n*/, const double* x, double* gradient, void* program) {
  return static_cast<Program*>(program)->cost(x, gradient);
}

void constraints(unsigned /*m*/, double* values, unsigned /*n*/, const double* x, double* gradients,
                 void* program) {
  static_cast<Program*>(program)->constrain(x, values, gradients);
}

}  // namespace

int NloptSolver::minimize(Program& program, std::vector<double>& x, int max_evaluations) {
  nlopt::opt method(algorithm_, static_cast<unsigned>(x.size()));
  method.set_min_objective(cost, &program);
  method.add_inequality_mconstraint(constraints, &program,
                                    std::vector<double>(program.constraints(), kTolerance));
  method.set_lower_bounds(program.decision().lower());
  method.set_upper_bounds(program.decision().upper());
  method.set_ftol_rel(kRelativeChange);
  method.set_maxeval(std::max(1, max_evaluations));
  double value = 0.0;
  try {
    method.optimize(x, value);
  } catch (const nlopt::roundoff_limited&) {
    // As near to the minimum as doubles allow.
  } catch (const std::runtime_error&) {
    // A method that cannot continue; x is the best so far, and judged as such.
  }
  return method.get_numevals();
}

}  // namespace trident::trajectories
