// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "comms/phy/packet_error.h"
#include "comms/phy/propagation.h"
#include "comms/phy/shadowing.h"
#include "comms/phy/vht.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

constexpr double kLambda_m = 0.0577;

TEST(FreeSpace, IsFriisFormula) {
  EXPECT_NEAR(free_space_loss_db(1000.0, kLambda_m), 106.77, 0.01);
  EXPECT_NEAR(free_space_loss_db(2000.0, kLambda_m) - free_space_loss_db(1000.0, kLambda_m),
              20.0 * std::log10(2.0), 1e-9);
  EXPECT_TRUE(std::isfinite(free_space_loss_db(0.0, kLambda_m)));
}

TEST(LogDistance, GrowsByItsExponentBeyondTheReference) {
  const double at_1 = log_distance_loss_db(1.0, kLambda_m, 3.1);
  EXPECT_NEAR(at_1, free_space_loss_db(1.0, kLambda_m), 1e-9);
  EXPECT_NEAR(log_distance_loss_db(100.0, kLambda_m, 3.1) - at_1, 62.0, 1e-9);
  EXPECT_NEAR(log_distance_loss_db(0.5, kLambda_m, 3.1), free_space_loss_db(0.5, kLambda_m), 1e-9);
}

/// Both rays as they are: two lengths, two phases, in extended precision.
double two_rays_apart_db(const OverWater& g) {
  using Complex = std::complex<long double>;
  const long double k = 2.0L * 3.14159265358979323846L / g.wavelength_m;
  const long double d1 =
      std::hypot((long double)g.distance_m, (long double)(g.height1_m - g.height2_m));
  const long double d2 =
      std::hypot((long double)g.distance_m, (long double)(g.height1_m + g.height2_m));
  const long double sine = (g.height1_m + g.height2_m) / d2;
  const long double cosine = g.distance_m / d2;
  const Complex eps(g.water.relative_permittivity,
                    -60.0L * g.water.conductivity_s_m * g.wavelength_m);
  const Complex z = g.polarization == Polarization::kVertical
                        ? std::sqrt(eps - cosine * cosine) / eps
                        : std::sqrt(eps - cosine * cosine);
  const long double s = g.water.significant_height_m / 4.0L;
  const long double rough = std::exp(-2.0L * std::pow(k * s * sine, 2.0L));
  const Complex reflected = g.reflecting_share * rough * (sine - z) / (sine + z);
  const Complex field = std::polar(1.0L / d1, -k * d1) + reflected * std::polar(1.0L / d2, -k * d2);
  return static_cast<double>(-20.0L * std::log10(std::abs(field) / (2.0L * k)));
}

TEST(TwoRays, AreTheSumOfBothOverHeightsDistancesPolarizationsAndSeas) {
  for (const Polarization polarization : {Polarization::kVertical, Polarization::kHorizontal}) {
    for (const double sea_m : {0.0, 0.1, 0.5, 1.25, 2.5}) {  // sea states 0 to 4
      for (int h = 0; h < 25; ++h) {
        for (int i = 0; i < 200; ++i) {
          OverWater g;
          g.height1_m = 0.3 + 0.4 * (h % 5);
          g.height2_m = 0.5 + 6.0 * (h / 5);
          g.distance_m = 2.0 * std::pow(1.037, i);
          g.wavelength_m = kLambda_m;
          g.polarization = polarization;
          g.water.significant_height_m = sea_m;
          const double expected_db = two_rays_apart_db(g);
          const double fade_db = expected_db - free_space_loss_db(g.distance_m, kLambda_m);
          if (fade_db > 50.0) continue;  // the model's fades have a bottom
          ASSERT_NEAR(two_ray_loss_db(g), expected_db, 0.05)
              << g.height1_m << " m, " << g.height2_m << " m, " << g.distance_m << " m";
        }
      }
    }
  }
}

TEST(TwoRays, FallBySixteenTimesPerOctaveBeyondTheBreakpoint) {
  OverWater g{2000.0, 2.0, 2.0, kLambda_m, 1.0, Polarization::kHorizontal, {}};
  const double near_db = two_ray_loss_db(g);
  g.distance_m = 4000.0;
  EXPECT_NEAR(two_ray_loss_db(g) - near_db, 40.0 * std::log10(2.0), 0.5);
}

TEST(KnifeEdge, HasTheValuesOfTheRecommendation) {
  EXPECT_EQ(knife_edge_loss_db(-0.78), 0.0);
  EXPECT_NEAR(knife_edge_loss_db(0.0), 6.03, 0.01);
  EXPECT_NEAR(knife_edge_loss_db(1.0), 13.93, 0.01);
  EXPECT_NEAR(knife_edge_loss_db(10.0), 32.88, 0.05);
  EXPECT_LT(knife_edge_loss_db(-0.77), 0.1);  // no step where it begins
  // The recommendation's own example form: v = h sqrt(2 (d1 + d2) / (lambda d1 d2)).
  EXPECT_NEAR(diffraction_parameter(2.0, 30.0, 70.0, kLambda_m),
              2.0 * std::sqrt(2.0 * 100.0 / (kLambda_m * 30.0 * 70.0)), 1e-12);
}

TEST(Bulge, CostsNothingNearbyAndHidesBeyondTheHorizon) {
  EXPECT_NEAR(bulge_loss_db(200.0, 2.0, 2.0, kLambda_m), 0.0, 0.01);
  EXPECT_GT(bulge_loss_db(40000.0, 2.0, 2.0, kLambda_m), 10.0);
}

TEST(Vht, HasTheRatesOfTheStandard) {
  const std::array<std::array<double, 3>, 10> rates{{{6.5, 13.5, 29.3},
                                                     {13, 27, 58.5},
                                                     {19.5, 40.5, 87.8},
                                                     {26, 54, 117},
                                                     {39, 81, 175.5},
                                                     {52, 108, 234},
                                                     {58.5, 121.5, 263.3},
                                                     {65, 135, 292.5},
                                                     {78, 162, 351},
                                                     {0, 180, 390}}};
  const std::array<int, 3> widths{20, 40, 80};
  for (int mcs = 0; mcs < vht::kModes; ++mcs) {
    for (std::size_t w = 0; w < 3; ++w) {
      if (!vht::is_mode(mcs, widths[w])) continue;
      const double expected = rates[static_cast<std::size_t>(mcs)][w];
      EXPECT_NEAR(vht::data_rate(mcs, widths[w], false) / 1e6, expected, 0.051);
      EXPECT_NEAR(vht::data_rate(mcs, widths[w], true) / 1e6, expected / 0.9, 0.06);
    }
  }
  EXPECT_FALSE(vht::is_mode(9, 20));
  EXPECT_FALSE(vht::is_mode(10, 80));
  EXPECT_EQ(vht::legacy_duration_ns(24, vht::kAckBytes), 28000);
  EXPECT_EQ(vht::legacy_duration_ns(6, vht::kAckBytes), 44000);
}

/// The ratio at which a frame is lost with that probability.
double ratio_at_db(int mcs, double loss, std::size_t bytes) {
  double low = -20.0, high = 60.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (packet_error_rate(mcs, middle, bytes) > loss ? low : high) = middle;
  }
  return low;
}

struct Point {
  double long_10, short_10, long_1, long_90;
};
// Ratios [dB] measured with ns-3 3.37.
constexpr std::array<Point, 10> kMeasured{{{0.94, 0.03, 1.58, -0.21},
                                           {3.95, 3.06, 4.61, 2.76},
                                           {6.44, 5.52, 7.13, 5.22},
                                           {9.72, 8.60, 10.49, 8.33},
                                           {12.82, 11.78, 13.58, 11.55},
                                           {17.06, 15.89, 17.99, 15.60},
                                           {18.39, 17.22, 19.32, 16.95},
                                           {19.65, 18.71, 20.52, 18.18},
                                           {23.73, 22.38, 24.78, 22.09},
                                           {25.17, 23.90, 26.18, 23.61}}};

TEST(PacketError, GoesThroughTheMeasuredPoints) {
  for (int mcs = 0; mcs < 10; ++mcs) {
    const Point& point = kMeasured[static_cast<std::size_t>(mcs)];
    EXPECT_NEAR(ratio_at_db(mcs, 0.1, 1500), point.long_10, 0.01);
    EXPECT_NEAR(ratio_at_db(mcs, 0.1, 100), point.short_10, 0.01);
    EXPECT_NEAR(ratio_at_db(mcs, 0.01, 1500), point.long_1, 0.01);
    EXPECT_NEAR(ratio_at_db(mcs, 0.9, 1500), point.long_90, 0.01);
  }
}

TEST(PacketError, FallsWithTheRatioAndGrowsWithTheLength) {
  for (int mcs = 0; mcs < 10; ++mcs) {
    double before = 1.0;
    for (double snr_db = -30.0; snr_db < 60.0; snr_db += 0.1) {
      const double loss = packet_error_rate(mcs, snr_db, 1500);
      ASSERT_LE(loss, before);
      ASSERT_GE(loss, 0.0);
      ASSERT_LE(packet_error_rate(mcs, snr_db, 500), loss);
      before = loss;
    }
    EXPECT_NEAR(packet_error_rate(mcs, -50.0, 10), 1.0, 1e-9);
    EXPECT_NEAR(packet_error_rate(mcs, 60.0, 11000), 0.0, 1e-9);
  }
  EXPECT_NEAR(noise_power_dbm(20, 7), -94.0, 0.02);
  EXPECT_NEAR(noise_power_dbm(80, 7), -88.0, 0.05);
}

TEST(Shadowing, HasItsSpreadAndCorrelation) {
  const ShadowingParams params{3.0, 8.0};
  const std::vector<double> shifts_m{2.0, 4.0, 8.0, 16.0};
  std::vector<double> products(shifts_m.size(), 0.0);
  double sum = 0.0, squares = 0.0;
  std::size_t count = 0;
  for (std::uint64_t pair = 0; pair < 2000; ++pair) {
    const ShadowField field(params, 7, "a" + std::to_string(pair));
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d a(40.0 * i, 3.0 * i, 1.0), b(-200.0, 55.0 * i, 0.5);
      const double here_db = field.at(a, b);
      sum += here_db;
      squares += here_db * here_db;
      ++count;
      for (std::size_t k = 0; k < shifts_m.size(); ++k) {
        products[k] += here_db * field.at(a + Eigen::Vector3d(0.6, 0.8, 0.0) * shifts_m[k], b);
      }
    }
  }
  const double n = static_cast<double>(count);
  EXPECT_EQ(count, 100000u);
  EXPECT_NEAR(sum / n, 0.0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / n), 3.0, 0.15);
  for (std::size_t k = 0; k < shifts_m.size(); ++k) {
    EXPECT_NEAR(products[k] / squares, std::exp(-shifts_m[k] / 8.0), 0.05) << shifts_m[k] << " m";
  }
}

TEST(Shadowing, IsTheSameAtTheSamePlaceAndHasNoSteps) {
  const ShadowField field({3.0, 8.0}, 7, "a/b"), again({3.0, 8.0}, 7, "a/b");
  const Eigen::Vector3d fixed(3.0, -4.0, 1.0);
  double before_db = field.at({0.0, 0.0, 0.3}, fixed);
  for (int i = 1; i < 10000; ++i) {
    const double here_db = field.at({0.1 * i, 0.0, 0.3}, fixed);
    ASSERT_LT(std::abs(here_db - before_db), 1.0);
    before_db = here_db;
  }
  EXPECT_EQ(field.at({5.0, 6.0, 0.3}, fixed), again.at({5.0, 6.0, 0.3}, fixed));
  EXPECT_NE(field.at({5.0, 6.0, 0.3}, fixed),
            ShadowField({3.0, 8.0}, 8, "a/b").at({5.0, 6.0, 0.3}, fixed));
  EXPECT_EQ(ShadowField({0.0, 8.0}, 7, "a/b").at({5.0, 6.0, 0.3}, fixed), 0.0);
}

}  // namespace
}  // namespace trident::sim
