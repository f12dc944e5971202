// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "trident_base/noise.h"
#include "trident_base/random_stream.h"
#include "trident_sim/param_tree.h"

namespace trident::sim {

/// Noise of one axis as SDF's `<noise type="gaussian">` has it (sdformat.org/spec, noise): white
/// noise, and a bias drawn once per stream, whose mean is negative as often as positive, as in
/// Gazebo.
struct AxisNoise {
  double mean = 0.0, stddev = 0.0;
  double bias_mean = 0.0, bias_stddev = 0.0;
  /// Bias that wanders, first-order Gauss-Markov; 0: it does not. [unit], [s]
  double dynamic_bias_stddev = 0.0, dynamic_bias_correlation_time_s = 0.0;
};

/// Noise of three axes as hector_gazebo_plugins have it: `<PREFIXOffset>`, `<PREFIXGaussianNoise>`,
/// `<PREFIXDrift>`, the spread of a bias that wanders, and `<PREFIXDriftFrequency>` (1/3600 Hz),
/// one over its correlation time. Three numbers, or one for all axes. Without prefix
/// they are `<offset>`, `<gaussianNoise>` ...
std::array<AxisNoise, 3> read_hector_noises(const PluginParams& params, const std::string& prefix);

/// Of x, y and z below an element ("angular_velocity"), which may be nullptr: no noise. Throws
/// Error that names owner, element, value and legal range.
std::array<AxisNoise, 3> read_axis_noises(const ParamNode* element, const std::string& owner);

/// Draws the noise of one axis, sample after sample of period `dt_s`. Uses four channels from
/// `channel` on, and GaussMarkov's for turning on.
class AxisNoiseSource {
 public:
  AxisNoiseSource(const AxisNoise& noise, double dt_s, std::uint32_t channel);

  /// What is added to sample `index`. Pass the same stream each time.
  double sample(const RandomStream& stream, std::uint64_t index);
  /// What of it is not white noise.
  double bias(const RandomStream& stream, std::uint64_t index);
  void reset();

 private:
  AxisNoise noise_;
  std::uint32_t channel_;
  std::optional<GaussMarkov> wandering_;
};

}  // namespace trident::sim
