// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "wave_params.h"

namespace trident::sim {

/// Wave number [1/m] of linear theory: omega^2 = g k tanh(k depth), by Newton's method. `depth_m`
/// may be infinite.
double wave_number(double omega_rad_s, double depth_m, double gravity_m_s2);

/// S(omega) [m^2 s] of jonswap and pierson_moskowitz (two-parameter form by height and peak), whose
/// integral over all frequencies is significant_height^2 / 16.
class SpectralDensity {
 public:
  explicit SpectralDensity(const WaveParams& params);
  double operator()(double omega_rad_s) const { return scale_ * shape(omega_rad_s); }

 private:
  double shape(double omega_rad_s) const;
  double peak_rad_s_;
  double enhancement_;
  double scale_ = 1.0;
};

/// One sine: amplitude cos(k direction . p - omega t + phase).
struct WaveComponent {
  double amplitude_m = 0.0;
  double omega_rad_s = 0.0;
  double k = 0.0;  ///< [1/m]
  double phase_rad = 0.0;
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
};

/// The sines of a sea: for spectra one in each of `components` equal bands between 0.5 and 4 times
/// the peak, at a random frequency in its band and with the band's energy; what lies outside (1 %)
/// is shared out, so that the significant height is the one that was asked for. Throws Error.
std::vector<WaveComponent> make_waves(const WaveParams& params, std::uint64_t seed);

}  // namespace trident::sim
