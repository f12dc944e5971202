// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "program.h"
#include "team_problems.h"
#include "trident_base/random_stream.h"

namespace trident::trajectories {
namespace {

/// An x that is nowhere special.
std::vector<double> somewhere(Program& program) {
  const RandomStream random(7, "gradient");
  std::vector<double> x(program.decision().variables());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = 0.3 * random.normal(i, 0);
  // No free duration may be the other's: the horizon is that of the longer one.
  x[x.size() - 2] = 0.1;
  x[x.size() - 1] = -0.1;
  return x;
}

/// Central differences against `gradient`, relative to the greatest slope.
template <class Function>
void expect_gradient(std::vector<double> x, const std::vector<double>& gradient, Function function,
                     const std::string& what) {
  constexpr double kStep = 1e-5;
  double scale = 1e-3;
  for (const double slope : gradient) scale = std::max(scale, std::abs(slope));
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double here = x[i];
    x[i] = here + kStep;
    const double above = function(x);
    x[i] = here - kStep;
    const double below = function(x);
    x[i] = here;
    EXPECT_NEAR(gradient[i] / scale, (above - below) / (2.0 * kStep) / scale, 1e-6)
        << what << ", variable " << i;
  }
}

struct Gradients : testing::Test {
  Problem problem = everything();
  Program program{problem, std::make_shared<SplineBasis>(7)};
  std::vector<double> x = somewhere(program);
};

TEST_F(Gradients, OfEachCostEqualDifferences) {
  for (const CostWeights& weights :
       {CostWeights{1, 0, 0, 0}, CostWeights{0, 1, 0, 0}, CostWeights{0, 0, 1, 0},
        CostWeights{0, 0, 0, 1}, problem.cost}) {
    Problem single = problem;
    single.cost = weights;
    Program own(single, std::make_shared<SplineBasis>(7));
    std::vector<double> gradient(x.size());
    own.cost(x.data(), gradient.data());
    expect_gradient(
        x, gradient, [&](const std::vector<double>& at) { return own.cost(at.data(), nullptr); },
        "cost");
  }
}

TEST_F(Gradients, OfEachConstraintEqualDifferences) {
  std::vector<double> gradients(x.size() * program.constraints());
  program.constrain(x.data(), nullptr, gradients.data());
  std::set<LimitKind> kinds;
  for (std::size_t i = 0; i < program.constraints(); ++i) {
    kinds.insert(program.constraint(i).limit());
    const auto row = gradients.begin() + static_cast<long>(i * x.size());
    expect_gradient(
        x, std::vector<double>(row, row + static_cast<long>(x.size())),
        [&](const std::vector<double>& at) {
          program.constrain(at.data(), nullptr, nullptr);
          return program.values()[i];
        },
        name_of(program.constraint(i).limit()));
  }
  EXPECT_EQ(kinds.size(), 12u) << "a kind of limit is not tested";
}

TEST_F(Gradients, OfTheLagrangianEqualDifferences) {
  std::vector<double> multipliers(program.constraints(), 0.7), gradient(x.size());
  program.lagrangian(x.data(), multipliers.data(), 3.0, gradient.data());
  std::vector<double> unused(x.size());
  expect_gradient(
      x, gradient,
      [&](const std::vector<double>& at) {
        return program.lagrangian(at.data(), multipliers.data(), 3.0, unused.data());
      },
      "lagrangian");
}

}  // namespace
}  // namespace trident::trajectories
