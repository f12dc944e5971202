// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "noise_table.h"

#include <cmath>

#include "lanes.h"

namespace trident::nav {
namespace {

// Shares of the horizon that noise is correlated over, and of the standard deviation, by lane.
constexpr double kCorrelationShare = 0.15;
constexpr float kScales[4] = {1.5F, 1.0F, 0.5F, 0.25F};
// More blocks than are used at once: each command takes others of them.
constexpr int kSpareBlocks = 16;

}  // namespace

NoiseTable::NoiseTable(const MppiModel& model, std::uint64_t seed, bool regenerates)
    : stream_(seed, "mppi"),
      blocks_(model.blocks + kSpareBlocks),
      steps_(model.steps),
      correlation_(std::exp(-1.0 / (kCorrelationShare * model.steps))),
      sigmas_{model.noise_std.vx, model.noise_std.vy, model.noise_std.wz},
      regenerates_(regenerates) {
  generate(0);
}

void NoiseTable::generate(std::uint64_t round) {
  for (const Axis axis : {kX, kY, kYaw}) {
    if (sigmas_[axis] > 0.0) generate_axis(axis, sigmas_[axis], round);
  }
}

void NoiseTable::generate_axis(Axis axis, double sigma, std::uint64_t round) {
  const auto kept = static_cast<float>(correlation_);
  const auto fresh = static_cast<float>(std::sqrt(1.0 - correlation_ * correlation_));
  const std::size_t block_size = static_cast<std::size_t>(steps_) * kLanes;
  values_[axis].resize(block_size * static_cast<std::size_t>(blocks_));
  std::uint64_t sample = round * values_[axis].size();
  for (std::size_t i = 0; i < values_[axis].size(); i += 4) {
    const auto normals = stream_.normals4(sample++, static_cast<std::uint32_t>(axis));
    const bool is_first = i % block_size < kLanes;
    for (std::size_t k = 0; k < 4; ++k) {
      const float drawn = static_cast<float>(sigma) * kScales[k] * normals[k];
      values_[axis][i + k] =
          is_first ? drawn : kept * values_[axis][i + k - kLanes] + fresh * drawn;
    }
  }
}

void NoiseTable::advance() {
  ++round_;
  if (regenerates_) generate(round_);
}

void NoiseTable::rewind() {
  if (regenerates_ && round_ != 0) generate(0);
  round_ = 0;
}

const float* NoiseTable::of(int block, Axis axis) const {
  if (values_[axis].empty()) return nullptr;
  const auto shift = stream_.bits(round_, 8) % static_cast<std::uint64_t>(blocks_);
  const auto row =
      (static_cast<std::uint64_t>(block) + shift) % static_cast<std::uint64_t>(blocks_);
  return values_[axis].data() + row * static_cast<std::uint64_t>(steps_) * kLanes;
}

float NoiseTable::sign(int block, Axis axis) const {
  const auto bits = stream_.bits(round_, static_cast<std::uint32_t>(16 + block));
  return ((bits >> axis) & 1U) != 0 ? 1.0F : -1.0F;
}

}  // namespace trident::nav
