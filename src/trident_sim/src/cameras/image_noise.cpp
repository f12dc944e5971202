// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "image_noise.h"

#include <array>
#include <cmath>

namespace trident::sim {
namespace {

constexpr std::size_t kBits = 12, kQuantiles = std::size_t{1} << kBits;
using Quantiles = std::array<float, kQuantiles>;

/// Where the normal distribution reaches `share` > 0.5, by bisection.
double quantile(double share) {
  double low = 0.0, high = 10.0;
  for (int round = 0; round < 60; ++round) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The middle of each of equally likely ranges, stretched to a variance of exactly one.
Quantiles make_quantiles() {
  std::array<double, kQuantiles / 2> upper;
  double squares = 0.0;
  for (std::size_t i = 0; i < upper.size(); ++i) {
    upper[i] = quantile(0.5 + (static_cast<double>(i) + 0.5) / kQuantiles);
    squares += upper[i] * upper[i];
  }
  const double scale = std::sqrt(static_cast<double>(upper.size()) / squares);
  Quantiles quantiles;
  for (std::size_t i = 0; i < upper.size(); ++i) {
    quantiles[2 * i] = static_cast<float>(scale * upper[i]);
    quantiles[2 * i + 1] = -quantiles[2 * i];
  }
  return quantiles;
}

/// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
  return x ^ (x >> 31);
}

}  // namespace

PacketFloats PixelNoise::normals(std::uint64_t packet) const {
  static const Quantiles quantiles = make_quantiles();
  PacketFloats result;
  for (std::size_t group = 0; group < kPacketLanes / 4; ++group) {
    std::uint64_t bits = mixed(key_ + 0x9E3779B97F4A7C15 * (4 * packet + group + 1));
    for (std::size_t i = 0; i < 4; ++i, bits >>= 16) {
      result[4 * group + i] = quantiles[bits & (kQuantiles - 1)];
    }
  }
  return result;
}

}  // namespace trident::sim
