// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "statistics.h"
#include "trident_base/error.h"

namespace trident {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kSamples = 50'000;
constexpr double kDt = 0.01;

ImuNoiseParams silent() {
  ImuNoiseParams params;
  params.gyroscope = {};
  params.accelerometer = {};
  return params;
}

TEST(Noise, ZeroPassesThroughToTheBit) {
  const RandomStream stream(1, "imu");
  EXPECT_EQ((GaussianNoise{0.5, 0.0}.sample(stream, 3, 0)), 0.5);
  EXPECT_EQ((WhiteNoise{0.0}.sample(stream, 3, 0, kDt)), 0.0);
  EXPECT_EQ((UniformNoise{0.25, 0.25}.sample(stream, 3, 0)), 0.25);
  ImuNoise noise(silent(), kDt, stream);
  for (std::uint64_t i = 0; i < 10; ++i) {
    Vector3d w(0.1, -0.2, 0.3);
    Vector3d f(0.0, 1.0, 9.8);
    noise.add(i, &w, &f);
    EXPECT_EQ(w, Vector3d(0.1, -0.2, 0.3));
    EXPECT_EQ(f, Vector3d(0.0, 1.0, 9.8));
  }
}

TEST(Noise, GaussianHasItsMeanAndSigma) {
  const RandomStream stream(1, "range");
  const GaussianNoise noise{2.0, 0.5};
  const Moments m =
      moments(draw_samples(kSamples, [&](std::size_t i) { return noise.sample(stream, i, 0); }));
  EXPECT_NEAR(m.mean, 2.0, 4 * 0.5 / std::sqrt(kSamples));
  EXPECT_NEAR(std::sqrt(m.variance), 0.5, 0.5 * 4 / std::sqrt(2.0 * kSamples));
}

TEST(Noise, WhiteNoiseDensityScalesWithTheSquareRootOfTheRate) {
  const RandomStream stream(1, "imu");
  for (const double dt : {0.001, 0.01, 0.25}) {
    const Moments m = moments(draw_samples(
        kSamples, [&](std::size_t i) { return WhiteNoise{0.004}.sample(stream, i, 0, dt); }));
    const double sigma = 0.004 / std::sqrt(dt);
    EXPECT_NEAR(m.mean, 0.0, 4 * sigma / std::sqrt(kSamples));
    EXPECT_NEAR(std::sqrt(m.variance), sigma, sigma * 4 / std::sqrt(2.0 * kSamples));
  }
}

TEST(Noise, UniformFillsItsInterval) {
  const RandomStream stream(1, "odometry");
  const UniformNoise noise{-0.5, 1.5};
  const auto samples =
      draw_samples(kSamples, [&](std::size_t i) { return noise.sample(stream, i, 0); });
  EXPECT_LT(kolmogorov_smirnov(samples, [](double x) { return (x + 0.5) / 2.0; }), 1.95);
}

TEST(Noise, VectorFormsUseOneChannelPerAxis) {
  const RandomStream stream(1, "odometry");
  const GaussianNoise3 gaussian{{1, 2, 3}, {0.1, 0.0, 0.3}};
  const Vector3d g = gaussian.sample(stream, 5, 10);
  EXPECT_EQ(g.x(), 1 + 0.1 * stream.normal(5, 10));
  EXPECT_EQ(g.y(), 2.0);
  EXPECT_EQ(g.z(), 3 + 0.3 * stream.normal(5, 12));
  const UniformNoise3 uniform{{-1, 0, 0}, {1, 2, 0}};
  const Vector3d u = uniform.sample(stream, 5, 20);
  EXPECT_EQ(u.x(), -1 + 2 * stream.uniform(5, 20));
  EXPECT_EQ(u.y(), 2 * stream.uniform(5, 21));
  EXPECT_EQ(u.z(), 0.0);
}

// Differences of successive samples of one IMU axis, where the bias hardly moves.
TEST(ImuNoise, WhitePartAgreesWithTheDensities) {
  ImuNoise noise(ImuNoiseParams{}, kDt, RandomStream(1, "imu"));
  std::vector<double> gyro;
  std::vector<double> accel;
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    Vector3d w = Vector3d::Zero();
    Vector3d f = Vector3d::Zero();
    noise.add(i, &w, &f);
    gyro.push_back(w.z());
    accel.push_back(f.x());
  }
  const auto white_sigma = [](const std::vector<double>& x) {
    return std::sqrt(
        moments(draw_samples(x.size() - 1, [&](std::size_t i) { return x[i + 1] - x[i]; }))
            .variance /
        2);
  };
  EXPECT_NEAR(white_sigma(gyro), 0.00033936958 / std::sqrt(kDt),
              0.00033936958 / std::sqrt(kDt) / 50);
  EXPECT_NEAR(white_sigma(accel), 0.004 / std::sqrt(kDt), 0.004 / std::sqrt(kDt) / 50);
}

TEST(ImuNoise, TurnOnBiasHasItsSpreadOverVehiclesAndAxes) {
  ImuNoiseParams params = silent();
  params.gyroscope.bias.turn_on_stddev = 0.01;
  params.accelerometer.bias.turn_on_stddev = 0.2;
  std::vector<double> gyro;
  std::vector<double> accel;
  for (int vehicle = 0; vehicle < 3000; ++vehicle) {
    ImuNoise noise(params, kDt, RandomStream(1, "UAV" + std::to_string(vehicle) + "/imu"));
    Vector3d w = Vector3d::Zero();
    Vector3d f = Vector3d::Zero();
    noise.add(0, &w, &f);
    const Vector3d w_first = w;
    w.setZero();
    noise.add(1, &w, &f);
    EXPECT_EQ(w, w_first);
    for (int axis = 0; axis < 3; ++axis) gyro.push_back(w[axis]);
    for (int axis = 0; axis < 3; ++axis) accel.push_back(f[axis] / 2);
  }
  EXPECT_NEAR(std::sqrt(moments(gyro).variance), 0.01, 0.01 / 25);
  EXPECT_NEAR(std::sqrt(moments(accel).variance), 0.2, 0.2 / 25);
  EXPECT_LT(std::abs(correlation(gyro, accel)), 4 / std::sqrt(9000.0));
}

TEST(ImuNoise, VehiclesOfOneKindDiffer) {
  ImuNoise first(ImuNoiseParams{}, kDt, RandomStream(1, "UAV1/imu"));
  ImuNoise second(ImuNoiseParams{}, kDt, RandomStream(1, "UAV2/imu"));
  std::vector<double> a;
  std::vector<double> b;
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    Vector3d w_a = Vector3d::Zero(), w_b = w_a, f_a = w_a, f_b = w_a;
    first.add(i, &w_a, &f_a);
    second.add(i, &w_b, &f_b);
    a.push_back(w_a.x());
    b.push_back(w_b.x());
  }
  std::vector<double> step_a = draw_samples(kSamples - 1, [&](auto i) { return a[i + 1] - a[i]; });
  std::vector<double> step_b = draw_samples(kSamples - 1, [&](auto i) { return b[i + 1] - b[i]; });
  // Differencing white noise halves the number of independent samples at worst.
  EXPECT_LT(std::abs(correlation(step_a, step_b)), 4 / std::sqrt(kSamples / 2.0));
  EXPECT_NE(a.front(), b.front());
}

TEST(ImuNoise, DoesNotDependOnWhichSamplesAreRead) {
  ImuNoise all(ImuNoiseParams{}, kDt, RandomStream(1, "imu"));
  ImuNoise some(ImuNoiseParams{}, kDt, RandomStream(1, "imu"));
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Vector3d w = Vector3d::Zero();
    Vector3d f = Vector3d::Zero();
    all.add(i, &w, &f);
    if (i % 37 != 5) continue;
    Vector3d w_some = Vector3d::Zero();
    Vector3d f_some = Vector3d::Zero();
    some.add(i, &w_some, &f_some);
    ASSERT_EQ(w, w_some);
    ASSERT_EQ(f, f_some);
  }
}

TEST(ImuNoise, ResetStartsTheSameRunAgain) {
  ImuNoise noise(ImuNoiseParams{}, kDt, RandomStream(1, "imu"));
  Vector3d w_first = Vector3d::Zero(), w_again = w_first, f = w_first, w_other = w_first;
  noise.add(0, &w_first, &f);
  noise.add(500, &w_other, &f);
  noise.reset();
  noise.add(0, &w_again, &f);
  EXPECT_EQ(w_first, w_again);
}

TEST(ImuNoise, IllegalParametersAreNamed) {
  ImuNoiseParams params;
  params.accelerometer.noise_density = -1.0;
  try {
    ImuNoise(params, kDt, RandomStream(1, "imu"));
    FAIL() << "a negative density was accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "noise: noise density = -1 must be >= 0");
  }
}

}  // namespace
}  // namespace trident
