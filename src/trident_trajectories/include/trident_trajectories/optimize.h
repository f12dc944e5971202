// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trident_trajectories/problem.h"
#include "trident_trajectories/trajectory.h"
#include "trident_trajectories/violation.h"

namespace trident::trajectories {

/// Where an optimizer begins.
enum class Start {
  kSwirlLeft,    ///< all pass the team's middle on their right, in a circle
  kSwirlRight,   ///< the reverse
  kSwirlLayers,  ///< to the left, and UAVs in layers
  kStraight,     ///< undisturbed paths
  kPriorities,   ///< one robot after another, each clear of those before it
  kRandom,       ///< undisturbed paths with noise of OptimizeOptions::seed
};

/// How an optimum is looked for.
struct OptimizeOptions {
  std::string method = "auglag";  ///< one of method_names()
  int segments = 7;               ///< polynomial pieces of each curve; 4 ... 60
  /// Of which the best feasible result counts. Where none is, kStraight and kPriorities follow.
  std::vector<Start> starts = {Start::kSwirlLeft, Start::kSwirlRight, Start::kSwirlLayers};
  int threads = 1;             ///< that starts are shared among; the result is the same
  bool use_fallbacks = true;   ///< whether kStraight and kPriorities follow
  int max_evaluations = 4000;  ///< of cost and limits, for each start
  double tolerance = 1e-4;     ///< relative violation that counts as none
  std::uint64_t seed = 0;      ///< of kRandom
  bool explain = true;         ///< look for the least change that makes a problem feasible
  /// What to begin with instead of `starts`, one trajectory a robot; may be empty.
  std::vector<Trajectory> warm_start;
};

/// What came out. The same problem and options give the same bits.
struct Solution {
  bool is_feasible = false;
  double cost = 0.0;                     ///< as weighted; 1 is about the undisturbed team's
  double jerk = 0.0;                     ///< sum of the integrals of squared jerk [m^2/s^5]
  std::vector<Trajectory> trajectories;  ///< one a robot; of an infeasible problem the nearest
  std::vector<Violation> violations;     ///< worst first; none of a feasible one
  std::string message;  ///< why not: limit, robots, time, by how much, and the least change
  std::string start;    ///< that led there
  int evaluations = 0;  ///< of cost and limits, of all starts
};

/// Names that OptimizeOptions::method may have: auglag (augmented Lagrangian with L-BFGS inside),
/// mma, ccsaq and slsqp.
std::vector<std::string> method_names();

/// Plans a team's paths. Throws Error for what is not legal: see validate(Problem), and an unknown
/// method or a number out of range in the options. A problem without a solution is no error.
Solution optimize(const Problem& problem, const OptimizeOptions& options = {});

}  // namespace trident::trajectories
