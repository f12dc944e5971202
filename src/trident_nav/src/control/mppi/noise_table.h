// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mppi_model.h"
#include "trident_base/random_stream.h"

namespace trident::nav {

/// What is added to the last plan: normal noise that is correlated along time, since only that
/// leads trajectories apart, with standard deviations that differ from lane to lane, so that some
/// samples explore and some refine.
class NoiseTable {
 public:
  enum Axis { kX = 0, kY = 1, kYaw = 2 };

  NoiseTable(const MppiModel& model, std::uint64_t seed, bool regenerates);

  /// Chooses other noise for the next command; each call of the same count gives the same.
  void advance();
  /// As it was when it was made.
  void rewind();
  /// Noise of a block of trajectories, [step][lane], up to its `sign`; nullptr for an axis that
  /// does not move.
  const float* of(int block, Axis axis) const;
  /// 1 or -1.
  float sign(int block, Axis axis) const;

 private:
  void generate(std::uint64_t round);
  void generate_axis(Axis axis, double sigma, std::uint64_t round);

  RandomStream stream_;
  int blocks_, steps_;
  double correlation_;  ///< Of the noise from step to step.
  double sigmas_[3];
  bool regenerates_;
  std::uint64_t round_ = 0;
  std::vector<float> values_[3];
};

}  // namespace trident::nav
