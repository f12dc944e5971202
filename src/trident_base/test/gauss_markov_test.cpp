// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "statistics.h"
#include "trident_base/error.h"
#include "trident_base/noise.h"

namespace trident {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kRuns = 4000;
// Four standard errors of a variance that is estimated from kRuns values, relative.
const double kVarianceTolerance = 4.0 * std::sqrt(2.0 / kRuns);

// Values of one sample index over many runs with different names.
std::vector<double> ensemble(const GaussMarkovParams& params, double dt, std::uint64_t index) {
  return draw_samples(kRuns, [&](std::size_t run) {
    const RandomStream stream(5, "run " + std::to_string(run));
    return GaussMarkov(params, dt, 0).sample(stream, index);
  });
}

TEST(GaussMarkov, RandomWalkVarianceGrowsWithTime) {
  for (const std::uint64_t steps : {1, 25, 100, 400}) {
    const Moments m = moments(ensemble({0.3, kInfinity, 0.0}, 0.01, steps - 1));
    const double expected = 0.3 * 0.3 * 0.01 * static_cast<double>(steps);
    EXPECT_NEAR(m.variance, expected, expected * kVarianceTolerance) << steps;
    EXPECT_NEAR(m.mean, 0.0, 4 * std::sqrt(expected / kRuns)) << steps;
  }
}

TEST(GaussMarkov, SettlesAtItsStationaryVariance) {
  const double stationary = 0.3 * 0.3 * 0.5 / 2;
  for (const std::uint64_t index : {300, 500}) {  // 6 and 10 correlation times
    const Moments m = moments(ensemble({0.3, 0.5, 0.0}, 0.01, index));
    EXPECT_NEAR(m.variance, stationary, stationary * kVarianceTolerance);
    EXPECT_NEAR(m.mean, 0.0, 4 * std::sqrt(stationary / kRuns));
  }
}

TEST(GaussMarkov, VarianceDoesNotDependOnTheSamplePeriod) {
  // Exact discretisation: the same variance after 0.4 s, however it is divided.
  const double tau = 0.5;
  const double expected = 0.3 * 0.3 * tau / 2 * (1 - std::exp(-2 * 0.4 / tau));
  for (const int steps : {1, 4, 40}) {
    const Moments m =
        moments(ensemble({0.3, tau, 0.0}, 0.4 / steps, static_cast<std::uint64_t>(steps) - 1));
    EXPECT_NEAR(m.variance, expected, expected * kVarianceTolerance) << steps;
  }
}

TEST(GaussMarkov, AutocorrelationDecaysWithTheCorrelationTime) {
  const GaussMarkovParams params{0.3, 0.5, 0.0};
  const auto reference = ensemble(params, 0.01, 400);
  for (const int lag : {10, 50, 100}) {
    const auto later = ensemble(params, 0.01, static_cast<std::uint64_t>(400 + lag));
    const double expected = std::exp(-0.01 * lag / 0.5);
    EXPECT_NEAR(correlation(reference, later), expected,
                4 * (1 - expected * expected) / std::sqrt(kRuns))
        << lag;
  }
}

TEST(GaussMarkov, TurnOnBiasIsConstantInARunAndSpreadOverRuns) {
  const GaussMarkovParams params{0.0, 100.0, 0.2};
  const RandomStream stream(5, "one run");
  GaussMarkov bias(params, 0.01, 0);
  const double first = bias.sample(stream, 0);
  EXPECT_NE(first, 0.0);
  EXPECT_EQ(bias.sample(stream, 1'000'000'000'000), first);
  EXPECT_NEAR(moments(ensemble(params, 0.01, 7)).variance, 0.04, 0.04 * kVarianceTolerance);
}

TEST(GaussMarkov, ValueDependsOnTheIndexAlone) {
  const GaussMarkovParams params{0.3, 0.5, 0.1};
  const RandomStream stream(5, "one run");
  GaussMarkov sequential(params, 0.01, 0);
  std::vector<double> values;
  for (std::uint64_t i = 0; i < 100; ++i) values.push_back(sequential.sample(stream, i));

  GaussMarkov jumping(params, 0.01, 0);
  EXPECT_EQ(jumping.sample(stream, 60), values[60]);  // skipped 60
  EXPECT_EQ(jumping.sample(stream, 60), values[60]);  // the same again
  EXPECT_EQ(jumping.sample(stream, 99), values[99]);
  EXPECT_EQ(jumping.sample(stream, 10), values[10]);  // back
  jumping.reset();
  EXPECT_EQ(jumping.sample(stream, 0), values[0]);
}

TEST(GaussMarkov, FollowsTheRecursion) {
  const RandomStream stream(5, "one run");
  const double phi = std::exp(-0.01 / 300.0);
  const double sigma = std::sqrt(-0.006 * 0.006 * 300.0 / 2 * (std::exp(-2 * 0.01 / 300.0) - 1));
  GaussMarkov bias({0.006, 300.0, 0.0}, 0.01, 4);
  double expected = 0.0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    expected = phi * expected + sigma * stream.normal(i, 4);
    EXPECT_NEAR(bias.sample(stream, i), expected, 1e-12);
  }
}

TEST(GaussMarkov, IllegalParametersAreNamed) {
  const auto error_of = [](const GaussMarkovParams& params, double dt) -> std::string {
    try {
      GaussMarkov(params, dt, 0);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of({0.1, 1.0, 0.1}, 0.0), "noise: sample period [s] = 0 must be > 0");
  EXPECT_EQ(error_of({-0.1, 1.0, 0.1}, 0.1), "noise: random walk = -0.1 must be >= 0");
  EXPECT_EQ(error_of({0.1, 0.0, 0.1}, 0.1), "noise: bias correlation time [s] = 0 must be > 0");
  EXPECT_EQ(error_of({0.1, NAN, 0.1}, 0.1), "noise: bias correlation time [s] = nan must be > 0");
  EXPECT_EQ(error_of({0.1, 1.0, kInfinity}, 0.1), "noise: turn-on bias sigma = inf must be >= 0");
  EXPECT_EQ(error_of({0.1, kInfinity, 0.1}, 0.1), "no error");
}

}  // namespace
}  // namespace trident
