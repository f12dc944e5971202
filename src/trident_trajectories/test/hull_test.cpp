// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "hull_check.h"
#include "program.h"
#include "search.h"
#include "team_problems.h"
#include "trident_base/random_stream.h"

namespace trident::trajectories {
namespace {

Bernstein random_polynomial(int degree, std::uint64_t seed) {
  const RandomStream random(seed, "bernstein");
  Bernstein out;
  out.degree = degree;
  for (int i = 0; i <= degree; ++i) out.c[i] = random.normal(static_cast<std::uint64_t>(i), 0);
  return out;
}

double value_at(Bernstein p, double u) {
  for (int step = p.degree; step > 0; --step)
    for (int i = 0; i < step; ++i) p.c[i] += u * (p.c[i + 1] - p.c[i]);
  return p.c[0];
}

TEST(Bernstein, ProductsSumsAndHalvesHaveTheValuesOfTheirPolynomials) {
  const Bernstein a = random_polynomial(5, 1), b = random_polynomial(3, 2);
  Bernstein left, right;
  a.split(left, right);
  for (const double u : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    EXPECT_NEAR(value_at(a * b, u), value_at(a, u) * value_at(b, u), 1e-12);
    EXPECT_NEAR(value_at(a - b, u), value_at(a, u) - value_at(b, u), 1e-12);
    EXPECT_NEAR(value_at(left, u), value_at(a, 0.5 * u), 1e-12);
    EXPECT_NEAR(value_at(right, u), value_at(a, 0.5 + 0.5 * u), 1e-12);
  }
}

TEST(Bernstein, GreatestRatioIsNeverBelowAnyValueNorFarAbove) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Bernstein top = random_polynomial(8, seed);
    const Bernstein root = random_polynomial(4, seed + 100);
    const Bernstein bottom = root * root + 0.1;
    double greatest = -std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 2000; ++k)
      greatest = std::max(greatest, value_at(top, k / 2000.0) / value_at(bottom, k / 2000.0));
    const double found = greatest_ratio(top, bottom, -1e9, 1e-6).value;
    EXPECT_GE(found, greatest - 1e-9);
    EXPECT_LE(found, greatest + 1e-3 * std::max(1.0, std::abs(greatest)));
  }
}

/// The worst of each constraint over fine samples, from first principles for those of pairs.
double sampled_separation(const Problem& problem, const std::vector<Trajectory>& paths,
                          std::size_t i, std::size_t j) {
  const double horizon = std::max(paths[i].duration(), paths[j].duration());
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= 20000; ++k) {
    Eigen::Vector3d delta = paths[i].at(horizon * k / 20000).p - paths[j].at(horizon * k / 20000).p;
    delta.z() /= vertical_factor(problem, i, j);
    least = std::min(least, delta.norm());
  }
  return least;
}

TEST(HullCheck, FindsWhatLiesBetweenSamples) {
  const Problem problem = everything();
  Program program(problem, std::make_shared<SplineBasis>(7));
  std::vector<double> x(program.decision().variables());
  const RandomStream random(3, "hull");
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = 0.2 * random.normal(i, 0);
  const std::vector<Trajectory> paths = program.trajectories(x.data());
  const HullCheck check(problem, paths);
  program.sharpness = 1e4;  // so that the smooth maximum is that of the samples
  program.constrain(x.data(), nullptr, nullptr);
  for (std::size_t i = 0; i < program.constraints(); ++i) {
    const Constraint& constraint = program.constraint(i);
    const double peak = check.peak(constraint).value;
    EXPECT_GE(std::max(peak, kPeakFloor), program.values()[i] - 2e-3)
        << name_of(constraint.limit());
    if (constraint.limit() != LimitKind::kSeparation || peak <= kPeakFloor) continue;
    const double bound = separation_of(problem, constraint.first(), constraint.second());
    const double reached = bound * (1.0 - relative_excess(LimitKind::kSeparation, peak));
    EXPECT_NEAR(reached,
                sampled_separation(problem, paths, constraint.first(), constraint.second()), 1e-3);
  }
}

}  // namespace
}  // namespace trident::trajectories
