// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "solvers/solver.h"

#include <array>

#include "solvers/augmented_lagrangian.h"
#include "solvers/nlopt_solver.h"
#include "trident_base/error.h"
#include "trident_trajectories/optimize.h"

namespace trident::trajectories {
namespace {

struct Method {
  const char* name;
  std::unique_ptr<Solver> (*make)();
};

template <nlopt::algorithm algorithm>
std::unique_ptr<Solver> make_nlopt() {
  return std::make_unique<NloptSolver>(algorithm);
}

std::unique_ptr<Solver> make_augmented_lagrangian() {
  return std::make_unique<AugmentedLagrangian>();
}

constexpr std::array kMethods = {
    Method{"auglag", make_augmented_lagrangian},
    Method{"mma", make_nlopt<nlopt::LD_MMA>},
    Method{"ccsaq", make_nlopt<nlopt::LD_CCSAQ>},
    Method{"slsqp", make_nlopt<nlopt::LD_SLSQP>},
};

}  // namespace

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  names.reserve(kMethods.size());
  for (const Method& method : kMethods) names.emplace_back(method.name);
  return names;
}

std::unique_ptr<Solver> make_solver(const std::string& name) {
  std::string legal;
  for (const Method& method : kMethods) {
    if (name == method.name) return method.make();
    legal += (legal.empty() ? "" : ", ") + std::string(method.name);
  }
  throw Error("method is '" + name + "'; legal are " + legal);
}

}  // namespace trident::trajectories
