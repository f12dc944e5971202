// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "marine/environment/wave_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "test_world.h"
#include "trident_base/angle.h"
#include "trident_base/random_stream.h"

namespace trident::sim {
namespace {

constexpr std::array<double, 2> kSurface = {0.0, 0.0};

WaveParams regular(double amplitude, double period) {
  WaveParams params;
  params.spectrum = WaveSpectrum::kRegular;
  params.amplitude = amplitude;
  params.period = period;
  return params;
}

WaveParams spectral(WaveSpectrum spectrum, double height, double period) {
  WaveParams params;
  params.spectrum = spectrum;
  params.significant_height = height;
  params.peak_period = period;
  return params;
}

TEST(WaveLanes, FunctionsAreThoseOfTheLibrary) {
  const RandomStream stream(1, "angles");
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double angle =
        (2.0 * stream.uniform(i, 0) - 1.0) * std::pow(10.0, 6.0 * stream.uniform(i, 1));
    const SineCosine lanes = sine_cosine(WaveLanes::Constant(angle));
    ASSERT_NEAR(lanes.sine[3], std::sin(angle), 1e-12) << angle;
    ASSERT_NEAR(lanes.cosine[7], std::cos(angle), 1e-12) << angle;
    const double x = 40.0 * stream.uniform(i, 2);
    ASSERT_NEAR(decaying(WaveLanes::Constant(x))[5] / std::exp(-x), 1.0, 1e-12) << x;
  }
  EXPECT_EQ(decaying(WaveLanes::Zero())[0], 1.0);
  EXPECT_LT(decaying(WaveLanes::Constant(1e9))[0], 1e-17);
}

TEST(Dispersion, SolvesItsEquationAtAnyDepth) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double omega : {0.3, 1.0, 3.0, 8.0}) {
    EXPECT_NEAR(wave_number(omega, infinity, 9.81), omega * omega / 9.81, 1e-12);
    for (const double depth : {0.05, 0.5, 3.0, 20.0, 1000.0}) {
      const double k = wave_number(omega, depth, 9.81);
      EXPECT_NEAR(9.81 * k * std::tanh(k * depth) / (omega * omega), 1.0, 1e-12)
          << omega << " " << depth;
    }
  }
  // Long waves run with sqrt(g h).
  EXPECT_NEAR(0.01 / wave_number(0.01, 2.0, 9.81), std::sqrt(9.81 * 2.0), 1e-3);
}

class FieldAtDepth : public testing::TestWithParam<double> {
 protected:
  WaveField field() const {
    WaveParams params = spectral(WaveSpectrum::kJonswap, 1.0, 5.0);
    params.components = 40;
    params.spreading = 5.0;
    params.depth = GetParam();
    return {params, 7};
  }
};

TEST_P(FieldAtDepth, OrbitalVelocityIsTheGradientOfThePotential) {
  const WaveField sea = field();
  const Eigen::Vector3d p(3.0, -2.0, -1.2);
  constexpr double h = 1e-5, t = 4.0;
  Eigen::Vector3d gradient, rate;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(axis);
    gradient[axis] = (sea.potential(p + step, t) - sea.potential(p - step, t)) / (2 * h);
  }
  EXPECT_TRUE(is_near(sea.motion(p, t).velocity, gradient, 1e-7));
  rate = (sea.motion(p, t + h).velocity - sea.motion(p, t - h).velocity) / (2 * h);
  EXPECT_TRUE(is_near(sea.motion(p, t).acceleration, rate, 1e-7));
}

TEST_P(FieldAtDepth, WaterIsNeitherMadeNorLost) {
  const WaveField sea = field();
  const Eigen::Vector3d p(3.0, -2.0, -1.2);
  constexpr double h = 1e-4;
  double divergence = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(axis);
    divergence += (sea.motion(p + step, 2).velocity - sea.motion(p - step, 2).velocity)[axis];
  }
  EXPECT_NEAR(divergence / (2 * h), 0.0, 1e-6);
}

TEST_P(FieldAtDepth, PressureObeysBernoulliAndIsTheElevationsAtTheSurface) {
  const WaveField sea = field();
  constexpr double h = 1e-5;
  const Eigen::Vector3d p(1.0, 0.5, -0.7);
  const double rate = (sea.potential(p, 3 + h) - sea.potential(p, 3 - h)) / (2 * h);
  EXPECT_NEAR(sea.dynamic_pressure_per_density(p, 3), -rate, 1e-7);
  const Eigen::Vector3d top(1.0, 0.5, 0.0);
  EXPECT_NEAR(sea.dynamic_pressure_per_density(top, 3) / 9.81, sea.elevation_m(top.head<2>(), 3),
              1e-9);
}

TEST_P(FieldAtDepth, SurfaceMovesWithItsWater) {
  const WaveField sea = field();
  const Eigen::Vector2d p(2.0, 1.0);
  constexpr double h = 1e-5;
  const WaterColumn column = sea.column(p, kSurface, 6.0);
  EXPECT_NEAR((sea.elevation_m(p, 6 + h) - sea.elevation_m(p, 6 - h)) / (2 * h),
              column.motion[0].velocity.z(), 1e-7);
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(axis);
    EXPECT_NEAR((sea.elevation_m(p + step, 6) - sea.elevation_m(p - step, 6)) / (2 * h),
                column.slope[axis], 1e-7);
  }
  EXPECT_EQ(column.elevation_m, sea.elevation_m(p, 6));
}

INSTANTIATE_TEST_SUITE_P(Depths, FieldAtDepth,
                         testing::Values(2.5, 30.0, std::numeric_limits<double>::infinity()));

TEST(WaveField, MotionDiesOutWithDepthAndIsFlatAtTheGround) {
  WaveParams params = regular(0.1, 4.0);
  const WaveField deep(params, 1);
  const double k = deep.components()[0].k;
  const double at_top = deep.motion({0, 0, 0}, 0).velocity.x();
  EXPECT_NEAR(at_top, 0.1 * 2 * kPi / 4.0, 1e-12);
  EXPECT_NEAR(deep.motion({0, 0, -2}, 0).velocity.x(), at_top * std::exp(-2 * k), 1e-12);
  params.depth = 2.0;
  const WaveField shallow(params, 1);
  EXPECT_NEAR(shallow.motion({0, 0, -2}, 1.0).velocity.z(), 0.0, 1e-12);
  EXPECT_GT(shallow.motion({0, 0, -2}, 0.0).velocity.x(), 0.05);
}

struct Statistics {
  double significant_height;
  std::vector<double> samples;
};

constexpr double kSample_s = 0.5;

Statistics hour_of(const WaveField& sea) {
  Statistics result{0.0, {}};
  double sum = 0.0, square = 0.0;
  for (int i = 0; i < 7200; ++i) {
    const double eta = sea.elevation_m({12.0, -3.0}, kSample_s * i);
    result.samples.push_back(eta);
    sum += eta;
    square += eta * eta;
  }
  const double mean = sum / 7200;
  result.significant_height = 4.0 * std::sqrt(square / 7200 - mean * mean);
  return result;
}

class IrregularSea : public testing::TestWithParam<WaveSpectrum> {};

TEST_P(IrregularSea, HasItsSignificantHeightOverAnHour) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const WaveField sea(spectral(GetParam(), 0.8, 5.0), seed);
    EXPECT_NEAR(hour_of(sea).significant_height / 0.8, 1.0, 0.03) << seed;
  }
}

/// Energy of a series between two frequencies, by its discrete Fourier transform.
double energy_between(const std::vector<double>& series, double lo, double hi) {
  const double n = static_cast<double>(series.size());
  const double width = 2 * kPi / (n * kSample_s);
  double energy = 0.0;
  for (int bin = static_cast<int>(std::ceil(lo / width)); bin * width < hi; ++bin) {
    std::complex<double> sum = 0.0, turn = 1.0;
    const std::complex<double> step = std::polar(1.0, -bin * width * kSample_s);
    for (const double value : series) {
      sum += value * turn;
      turn *= step;
    }
    energy += 2.0 * std::norm(sum / n);
  }
  return energy;
}

TEST_P(IrregularSea, HasTheSpectrumThatWasAskedFor) {
  const WaveParams params = spectral(GetParam(), 0.8, 5.0);
  const std::vector<double> samples = hour_of(WaveField(params, 4)).samples;
  const SpectralDensity density(params);
  const double peak = 2 * kPi / 5.0, total = 0.8 * 0.8 / 16.0;
  double shown = 0.0;
  for (const double part : {0.7, 0.9, 1.1, 1.4, 1.8, 2.5}) {
    const double lo = part * peak, hi = lo * 1.25;
    double wanted = 0.0;
    for (int i = 0; i < 1000; ++i) wanted += density(lo + (i + 0.5) * (hi - lo) / 1000);
    wanted *= (hi - lo) / 1000;
    EXPECT_NEAR(energy_between(samples, lo, hi) / total, wanted / total, 0.02) << part;
    shown += wanted / total;
  }
  EXPECT_GT(shown, 0.7);
}

INSTANTIATE_TEST_SUITE_P(Spectra, IrregularSea,
                         testing::Values(WaveSpectrum::kPiersonMoskowitz, WaveSpectrum::kJonswap));

TEST(Spectrum, JonswapPeaksHigherThanPiersonMoskowitzAtTheSameHeight) {
  const SpectralDensity pm(spectral(WaveSpectrum::kPiersonMoskowitz, 1.0, 6.0));
  const SpectralDensity jonswap(spectral(WaveSpectrum::kJonswap, 1.0, 6.0));
  const double peak = 2 * kPi / 6.0;
  EXPECT_NEAR(pm(peak), 5.0 / 16.0 / peak * std::exp(-1.25), 1e-3 * pm(peak));
  // gamma (1 - 0.287 ln gamma): the usual approximation of the ratio.
  EXPECT_NEAR(jonswap(peak) / pm(peak), 3.3 * (1 - 0.287 * std::log(3.3)), 0.05);
}

TEST(WaveField, SeedMakesTheSea) {
  const WaveParams params = spectral(WaveSpectrum::kJonswap, 1.0, 5.0);
  EXPECT_EQ(WaveField(params, 1).elevation_m({1, 2}, 3),
            WaveField(params, 1).elevation_m({1, 2}, 3));
  EXPECT_NE(WaveField(params, 1).elevation_m({1, 2}, 3),
            WaveField(params, 2).elevation_m({1, 2}, 3));
}

TEST(WaveField, SpreadingTurnsDirectionsAboutTheMeanOne) {
  WaveParams params = spectral(WaveSpectrum::kJonswap, 1.0, 5.0);
  params.direction = 0.5;
  params.components = 1000;
  const auto moments = [&](double spreading) {
    params.spreading = spreading;
    double mean = 0.0, square = 0.0;
    for (const WaveComponent& wave : make_waves(params, 1)) {
      const double turn = wrap_to_pi(std::atan2(wave.direction.y(), wave.direction.x()) - 0.5);
      mean += turn / 1000;
      square += turn * turn / 1000;
    }
    return std::pair(mean, std::sqrt(square));
  };
  EXPECT_EQ(moments(0.0).second < 1e-9, true);
  EXPECT_NEAR(moments(10.0).first, 0.0, 0.03);
  EXPECT_NEAR(moments(10.0).second, std::sqrt(2.0 / 11.0), 0.03);  // sqrt(2 / (s + 1))
}

/// Amplitudes of VRX' default sea, 5.3, 27.3 and 17.9 mm.
TEST(WaveField, VrxSamplesItsSpectrum) {
  WaveParams params;
  params.spectrum = WaveSpectrum::kVrxPms;
  params.gravity = 9.8;
  const std::vector<WaveComponent> waves = make_waves(params, 1);
  ASSERT_EQ(waves.size(), 3U);
  EXPECT_NEAR(waves[0].amplitude_m, 0.0053, 5e-5);
  EXPECT_NEAR(waves[1].amplitude_m, 0.0273, 5e-5);
  EXPECT_NEAR(waves[2].amplitude_m, 0.0179, 5e-5);
  EXPECT_NEAR(waves[2].omega_rad_s / waves[1].omega_rad_s, 1.5, 1e-12);
  EXPECT_NEAR(std::atan2(waves[2].direction.y(), waves[2].direction.x()), 0.4, 1e-12);

  params.spectrum = WaveSpectrum::kVrxCwr;
  params.amplitude = 0.2;
  const std::vector<WaveComponent> ratio = make_waves(params, 1);
  EXPECT_NEAR(ratio[2].amplitude_m * ratio[2].k, 0.2 * ratio[1].k, 1e-12);
  EXPECT_NEAR(ratio[2].amplitude_m, 0.3, 1e-12);
}

TEST(Gerstner, ParticlesOfTheSurfaceLieOnIt) {
  WaveParams params = regular(0.4, 3.0);
  params.model = WaveModel::kGerstner;
  const WaveField sea(params, 1);
  const double k = sea.components()[0].k;
  double highest = -1, lowest = 1;
  for (double rest = 0.0; rest < 2 * kPi / k; rest += 0.05) {
    const double theta = k * rest;
    const double x = rest - 0.4 * std::sin(theta), z = 0.4 * std::cos(theta);
    EXPECT_NEAR(sea.elevation_m({x, 5.0}, 0.0), z, 1e-6);
    highest = std::max(highest, sea.elevation_m({rest, 0}, 0));
    lowest = std::min(lowest, sea.elevation_m({rest, 0}, 0));
  }
  EXPECT_NEAR(highest - lowest, 0.8, 0.01);
  // Crests are sharper than troughs: the surface is below its mean for longer.
  EXPECT_LT(sea.elevation_m({0.25 * 2 * kPi / k, 0}, 0.0), -0.05);
}

TEST(Gerstner, SlopeIsThatOfTheSurface) {
  WaveParams params = spectral(WaveSpectrum::kJonswap, 0.6, 4.0);
  params.model = WaveModel::kGerstner;
  params.components = 30;
  params.spreading = 3.0;
  const WaveField sea(params, 5);
  constexpr double h = 1e-4;
  const Eigen::Vector2d p(2, 3);
  const Eigen::Vector2d slope = sea.column(p, kSurface, 1.0).slope;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(axis);
    EXPECT_NEAR((sea.elevation_m(p + step, 1) - sea.elevation_m(p - step, 1)) / (2 * h),
                slope[axis], 1e-4);
  }
}

TEST(WaveField, GrowsFromNothingAndFadesAtTheShore) {
  WaveParams params = regular(0.2, 4.0);
  params.ramp_time = 2.0;
  params.shore_depth = 4.0;
  // The ground rises towards +x: 4 m deep at x = -10, dry at x = 0.
  const WaveField sea(params, 1, [](const Eigen::Vector2d& p, double) { return -0.4 * p.x(); });
  EXPECT_EQ(sea.strength({-50, 0}, 0.0), 0.0);
  EXPECT_NEAR(sea.strength({-50, 0}, 2.0), 1 - std::exp(-1.0), 1e-12);
  EXPECT_NEAR(sea.strength({-5, 0}, 1e9), 0.5, 1e-12);
  EXPECT_EQ(sea.strength({1, 0}, 1e9), 0.0);
  EXPECT_EQ(sea.elevation_m({1, 0}, 1e4), 0.0);
  EXPECT_EQ(sea.column({1, 0}, kSurface, 1e4).motion[0].velocity.norm(), 0.0);
}

TEST(WaveField, TideLiftsTheSurface) {
  WaveField sea(regular(0.2, 4.0), 1);
  const double before = sea.elevation_m({1, 2}, 3);
  sea.set_level(0.7);
  EXPECT_NEAR(sea.elevation_m({1, 2}, 3), before + 0.7, 1e-12);
  EXPECT_NEAR(sea.column({1, 2}, kSurface, 3).elevation_m, before + 0.7, 1e-12);
}

TEST(WaveParams, BadInputIsNamed) {
  const auto refusal = [](const std::string& text) {
    return error_of([&] { load_yaml_string<WaveParams>(text, "sea.yaml"); });
  };
  EXPECT_TRUE(
      contains(refusal("significant_height: -0.5\n"), "sea.yaml:1: significant_height: -0.5"));
  EXPECT_TRUE(contains(refusal("spectrum: jonswop\n"), "jonswap"));
  EXPECT_TRUE(contains(refusal("spectrum: regular\namplitude: 1.2\nperiod: 2\n"),
                       "amplitude = 1.2 m breaks at period = 2 s"));
  WaveParams params = spectral(WaveSpectrum::kJonswap, -1.0, 5.0);
  EXPECT_TRUE(contains(error_of([&] { WaveField(params, 1); }), "significant_height = -1"));
}

}  // namespace
}  // namespace trident::sim
