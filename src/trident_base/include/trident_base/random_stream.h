// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace trident {

/// Philox4x32-10: ten rounds of a keyed bijection on 128-bit counters.
/// Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC 2011.
std::array<std::uint32_t, 4> philox4x32_10(const std::array<std::uint32_t, 4>& counter,
                                           const std::array<std::uint32_t, 2>& key);

/// The random numbers of one entity (a sensor, a link). Each number is a pure function of (world
/// seed, entity name, sample index, channel): nothing that another entity or a subscriber does can
/// shift it, and it can be asked for in any order. Distributions are our own, because those of
/// <random> differ between standard libraries. Cheap to copy; no allocation.
class RandomStream {
 public:
  /// `entity_name` is the full scoped name, e.g. "UAV1/firefly/imu".
  RandomStream(std::uint64_t world_seed, std::string_view entity_name);

  /// Uniform in [0, 1) with 53 random bits.
  double uniform(std::uint64_t sample_index, std::uint32_t channel) const;

  /// Standard normal: zero mean, unit variance (Box-Muller). Independent of `uniform` at the same
  /// index and channel.
  double normal(std::uint64_t sample_index, std::uint32_t channel) const;

  /// Four standard normals for about the price of one, to six decimals: the noise of what is
  /// measured by the million. They do not go beyond 6.7. Independent of `normal`.
  std::array<float, 4> normals4(std::uint64_t sample_index, std::uint32_t channel) const;

  /// 64 random bits, for discrete choices. Independent of `uniform` and `normal`.
  std::uint64_t bits(std::uint64_t sample_index, std::uint32_t channel) const;

 private:
  enum class Use : std::uint32_t { kUniform = 0, kNormal = 1, kBits = 2, kNormals4 = 3 };
  std::array<std::uint32_t, 4> block(std::uint64_t sample_index, std::uint32_t channel,
                                     Use use) const;

  std::array<std::uint32_t, 2> key_;
};

}  // namespace trident
