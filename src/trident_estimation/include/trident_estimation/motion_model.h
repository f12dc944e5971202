// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "trident_base/random_stream.h"
#include "trident_base/se2.h"
#include "trident_estimation/amcl_params.h"
#include "trident_estimation/particle_set.h"

namespace trident::estimation {

/// Moves particles as odometry says, each with errors of its own.
class MotionModel {
 public:
  /// Equal seeds and steps give equal errors, whatever was drawn before.
  MotionModel(const MotionModelParams& params, std::uint64_t seed);

  /// `T_old_new`: the robot's motion by odometry. `step` numbers the calls: errors are a function
  /// of (seed, step, particle).
  void apply(const SE2& T_old_new, std::uint64_t step, ParticleSet& particles);

 private:
  struct Normals;
  void draw(std::uint64_t step, std::size_t count);
  void apply_diff(const SE2& T_old_new, ParticleSet& particles);
  void apply_omni(const SE2& T_old_new, ParticleSet& particles);
  float deviation(double variance) const;

  MotionModelParams params_;
  RandomStream random_;
  std::vector<float> quantiles_;  ///< of the standard normal, at equal steps of probability
  std::vector<float> first_, second_, third_;  ///< standard normals of each particle
  std::vector<float> heading_, sine_, cosine_;
};

}  // namespace trident::estimation
