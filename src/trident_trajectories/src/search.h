// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "hull_check.h"
#include "solvers/solver.h"
#include "trident_trajectories/optimize.h"

namespace trident::trajectories {

/// Where one start led.
struct Found {
  bool is_feasible = false;
  double cost = 0.0;
  double worst = 0.0;  ///< relative violation, of all limits
  std::vector<double> x;
  int evaluations = 0;
};

/// Improves `x` by a method, looks at what is between the samples, moves limits by what was missed
/// there, and repeats that until limits are kept at all instants and nothing more is to be gained.
Found search(const Problem& problem, const std::shared_ptr<const SplineBasis>& basis,
             const OptimizeOptions& options, std::vector<double> x);

/// `search` from a named start.
Found search_from(Start start, const Problem& problem,
                  const std::shared_ptr<const SplineBasis>& basis, const OptimizeOptions& options);

/// The relative excess of a constraint whose g is given: of its limit, not of its square.
double relative_excess(LimitKind kind, double g);

}  // namespace trident::trajectories
