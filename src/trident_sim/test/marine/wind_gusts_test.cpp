// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "marine/environment/wind_gusts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "test_world.h"

namespace trident::sim {
namespace {

DrydenParams breeze() {
  DrydenParams params;
  params.wind_at_6m = 8.0;
  params.altitude = 15.0;
  return params;
}

TEST(DrydenGusts, FiguresAreThoseOfTheSpecification) {
  // At 1000 ft the three intensities and lengths coincide (0.177 + 0.823 = 1).
  DrydenParams params = breeze();
  params.altitude = 304.8;
  EXPECT_NEAR(params.intensities()[0], 0.8, 1e-6);
  EXPECT_NEAR(params.intensities()[2], 0.8, 1e-6);
  EXPECT_NEAR(params.lengths()[0], 304.8, 1e-3);
  EXPECT_NEAR(params.lengths()[2], 304.8, 1e-3);
}

Eigen::Vector3d standard_deviations(double dt_s, int steps) {
  DrydenGusts gusts(breeze(), dt_s, 3, "wind");
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < steps; ++i) {
    sum += gusts.gust().cwiseAbs2();
    gusts.step();
  }
  return (sum / steps).cwiseSqrt();
}

TEST(DrydenGusts, IntensityDoesNotDependOnTheStep) {
  const Eigen::Vector3d expected = breeze().intensities();
  for (const double dt_s : {0.02, 0.5}) {
    const Eigen::Vector3d sigma = standard_deviations(dt_s, 400000);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(sigma[i] / expected[i], 1.0, 0.08) << dt_s << " " << i;
  }
}

/// The correlation that belongs to Dryden's spectra: exp(-V t / L) along the wind, and
/// exp(-V t / L) (1 - V t / (2 L)) across and above it.
TEST(DrydenGusts, CorrelationIsDrydens) {
  constexpr double kStep = 0.1;
  constexpr int kSamples = 400000;
  DrydenGusts gusts(breeze(), kStep, 4, "wind");
  std::vector<Eigen::Vector3d> series;
  for (int i = 0; i < kSamples; ++i) {
    series.push_back(gusts.gust());
    gusts.step();
  }
  const Eigen::Vector3d sigma = breeze().intensities();
  for (int axis = 0; axis < 3; ++axis) {
    const double rate = 8.0 / breeze().lengths()[axis];
    const int lag = static_cast<int>(std::lround(0.7 / rate / kStep));
    double sum = 0.0;
    for (int i = 0; i + lag < kSamples; ++i) {
      sum += series[static_cast<std::size_t>(i)][axis] *
             series[static_cast<std::size_t>(i + lag)][axis];
    }
    const double x = rate * lag * kStep;
    const double expected = std::exp(-x) * (axis == 0 ? 1.0 : 1.0 - 0.5 * x);
    EXPECT_NEAR(sum / (kSamples - lag) / (sigma[axis] * sigma[axis]), expected, 0.08) << axis;
  }
}

TEST(DrydenGusts, AreTheSameAfterAResetAndWithTheSameSeedOnly) {
  DrydenGusts a(breeze(), 0.01, 3, "wind"), b(breeze(), 0.01, 3, "wind"),
      other(breeze(), 0.01, 4, "wind");
  const Eigen::Vector3d first = a.gust();
  for (int i = 0; i < 100; ++i) {
    a.step();
    b.step();
    other.step();
  }
  EXPECT_EQ(a.gust(), b.gust());
  EXPECT_NE(a.gust(), other.gust());
  a.reset();
  EXPECT_EQ(a.gust(), first);
  EXPECT_TRUE(contains(error_of([] { DrydenGusts(breeze(), 0.0, 3, "wind"); }), "dt = 0"));
}

TEST(DrydenGusts, NoWindNoGusts) {
  DrydenGusts gusts(DrydenParams{}, 0.01, 3, "wind");
  gusts.step();
  EXPECT_EQ(gusts.gust().norm(), 0.0);
}

}  // namespace
}  // namespace trident::sim
