// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "program.h"

namespace trident::trajectories {

/// Minimizes a program from where it was left.
class Solver {
 public:
  virtual ~Solver() = default;
  /// Improves x, which may be called again after shifts have changed; the number of evaluations.
  virtual int minimize(Program& program, std::vector<double>& x, int max_evaluations) = 0;
  /// Says, before minimize(), that x is feasible or nearly so: do not leave it far.
  virtual void begin_near() {}
  /// How much better the cost could become where constraints with a price are not at their
  /// limit; 0 where that is not known.
  virtual double slack_price(const std::vector<double>& /*values*/) const { return 0.0; }
};

/// By name; throws Error listing the names.
std::unique_ptr<Solver> make_solver(const std::string& method);

}  // namespace trident::trajectories
