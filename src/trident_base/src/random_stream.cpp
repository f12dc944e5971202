// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/random_stream.h"

#include <cmath>

#include "trident_base/angle.h"

namespace trident {
namespace {

constexpr int kRounds = 10;
constexpr std::uint32_t kMultiplier0 = 0xD2511F53;
constexpr std::uint32_t kMultiplier1 = 0xCD9E8D57;
constexpr std::uint32_t kWeyl0 = 0x9E3779B9;  // golden ratio
constexpr std::uint32_t kWeyl1 = 0xBB67AE85;  // sqrt(3) - 1

// FNV-1a, 64 bit: unlike std::hash, the same on every platform.
std::uint64_t fnv1a(std::string_view text) {
  std::uint64_t hash = 0xCBF29CE484222325;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001B3;
  }
  return hash;
}

// SplitMix64 finaliser (Steele, Lea, Flood, OOPSLA 2014): spreads neighbouring seeds over all bits.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
  return x ^ (x >> 31);
}

std::uint64_t join_words(std::uint32_t high, std::uint32_t low) {
  return (std::uint64_t{high} << 32) | low;
}

// [0, 1) with 53 bits.
double to_unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1.0p-53; }

/// Box-Muller on 32 bits each; single precision is quicker and enough for noise.
void box_muller(std::uint32_t for_radius, std::uint32_t for_angle, float* two) {
  const float u = (static_cast<float>(for_radius) + 0.5F) * 0x1.0p-32F;  // in (0, 1]
  const float radius = std::sqrt(-2.0F * std::log(u));
  const float angle = static_cast<float>(2.0 * kPi * 0x1.0p-32) * static_cast<float>(for_angle);
  two[0] = radius * std::cos(angle);
  two[1] = radius * std::sin(angle);
}

}  // namespace

std::array<std::uint32_t, 4> philox4x32_10(const std::array<std::uint32_t, 4>& counter,
                                           const std::array<std::uint32_t, 2>& key) {
  auto [c0, c1, c2, c3] = counter;
  auto [k0, k1] = key;
  for (int round = 0; round < kRounds; ++round) {
    const std::uint64_t product0 = std::uint64_t{kMultiplier0} * c0;
    const std::uint64_t product1 = std::uint64_t{kMultiplier1} * c2;
    c0 = static_cast<std::uint32_t>(product1 >> 32) ^ c1 ^ k0;
    c1 = static_cast<std::uint32_t>(product1);
    c2 = static_cast<std::uint32_t>(product0 >> 32) ^ c3 ^ k1;
    c3 = static_cast<std::uint32_t>(product0);
    k0 += kWeyl0;
    k1 += kWeyl1;
  }
  return {c0, c1, c2, c3};
}

RandomStream::RandomStream(std::uint64_t world_seed, std::string_view entity_name) {
  const std::uint64_t key = mix(mix(world_seed) ^ fnv1a(entity_name));
  key_ = {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)};
}

std::array<std::uint32_t, 4> RandomStream::block(std::uint64_t sample_index, std::uint32_t channel,
                                                 Use use) const {
  return philox4x32_10(
      {static_cast<std::uint32_t>(sample_index), static_cast<std::uint32_t>(sample_index >> 32),
       channel, static_cast<std::uint32_t>(use)},
      key_);
}

double RandomStream::uniform(std::uint64_t sample_index, std::uint32_t channel) const {
  const auto words = block(sample_index, channel, Use::kUniform);
  return to_unit(join_words(words[0], words[1]));
}

double RandomStream::normal(std::uint64_t sample_index, std::uint32_t channel) const {
  const auto words = block(sample_index, channel, Use::kNormal);
  // 1 - u is in (0, 1], so the logarithm is finite.
  const double radius = std::sqrt(-2.0 * std::log(1.0 - to_unit(join_words(words[0], words[1]))));
  return radius * std::cos(2.0 * kPi * to_unit(join_words(words[2], words[3])));
}

std::array<float, 4> RandomStream::normals4(std::uint64_t sample_index,
                                            std::uint32_t channel) const {
  const auto words = block(sample_index, channel, Use::kNormals4);
  std::array<float, 4> result;
  box_muller(words[0], words[1], &result[0]);
  box_muller(words[2], words[3], &result[2]);
  return result;
}

std::uint64_t RandomStream::bits(std::uint64_t sample_index, std::uint32_t channel) const {
  const auto words = block(sample_index, channel, Use::kBits);
  return join_words(words[0], words[1]);
}

}  // namespace trident
