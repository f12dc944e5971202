// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/phy/shadowing.h"

#include <cmath>
#include <string>

#include "trident_base/angle.h"
#include "trident_base/random_stream.h"

namespace trident::sim {
namespace {

constexpr std::uint64_t kWaves = 48;
// Largest wave number, in 1 / decorrelation. What lies beyond has 3 % of the power.
constexpr double kMaxWaveNumber = 40.0;

/// Share of the power in wave numbers up to k, of exp(-r) in three dimensions: its density is
/// (4 / pi) k^2 / (1 + k^2)^2.
double share_below(double k) { return 2.0 / kPi * (std::atan(k) - k / (1.0 + k * k)); }

/// The wave number below which that share of the power lies; by bisection, as it is done once.
double wave_number_of(double share) {
  double low = 0.0, high = kMaxWaveNumber;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (share_below(middle) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Eigen::Vector3d direction(double u, double v) {
  const double z = 2.0 * u - 1.0;
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(2.0 * kPi * v), r * std::sin(2.0 * kPi * v), z};
}

}  // namespace

ShadowField::ShadowField(const ShadowingParams& params, std::uint64_t seed, std::string_view pair) {
  if (params.stddev_db <= 0.0) return;
  amplitude_db_ = params.stddev_db * std::sqrt(2.0 / static_cast<double>(kWaves));
  const RandomStream random(seed, "radio/shadow/" + std::string(pair));
  const double whole = share_below(kMaxWaveNumber);
  for (std::uint64_t i = 0; i < kWaves; ++i) {
    const auto u = [&](std::uint32_t channel) { return random.uniform(i, channel); };
    // Each wave of its own stratum of wave numbers, so that every pair has the whole spectrum.
    const auto length = [&](std::uint64_t stratum, std::uint32_t channel) {
      const double share = (static_cast<double>(stratum) + u(channel)) / kWaves;
      return wave_number_of(whole * share) / params.decorrelation_m;
    };
    // The second end's strata in another order: a permutation, as 29 and 48 have no divisor.
    const std::uint64_t other = (29 * i + 17) % kWaves;
    waves_.push_back({length(i, 0) * direction(u(1), u(2)),
                      length(other, 3) * direction(u(4), u(5)), 2.0 * kPi * u(6)});
  }
}

double ShadowField::at(const Eigen::Vector3d& p_first, const Eigen::Vector3d& p_second) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) {
    sum += std::cos(wave.k_first.dot(p_first) + wave.k_second.dot(p_second) + wave.phase);
  }
  return amplitude_db_ * sum;
}

}  // namespace trident::sim
