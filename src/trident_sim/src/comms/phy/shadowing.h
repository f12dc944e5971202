// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>
#include <vector>

namespace trident::sim {

/// What slow fading is like.
struct ShadowingParams {
  double stddev_db = 3.0;        ///< >= 0; 0: no shadowing
  double decorrelation_m = 8.0;  ///< path over which the correlation falls to 1/e, > 0
};

/// The slow fading between two radios as a function of where both are: the same places have the
/// same shadow, whichever path they were reached, and in both directions. Normal over pairs and
/// seeds, with zero mean; where one end moves by dx the correlation is exp(-|dx| / decorrelation)
/// (Gudmundson 1991).
///
/// A sum of plane waves over both ends' places, whose wave numbers are drawn from the spectrum of
/// that correlation (random Fourier features; Rahimi and Recht 2007), without those shorter than a
/// seventh of the decorrelation path, so that it has no steps.
class ShadowField {
 public:
  /// `pair` names the pair, in an order that does not depend on the direction.
  ShadowField(const ShadowingParams& params, std::uint64_t seed, std::string_view pair);

  /// [dB], to be added to the loss. `p_first` and `p_second` in the world, in the pair's order [m].
  double at(const Eigen::Vector3d& p_first, const Eigen::Vector3d& p_second) const;

 private:
  struct Wave {
    Eigen::Vector3d k_first, k_second;  ///< [rad/m]
    double phase = 0.0;
  };
  std::vector<Wave> waves_;
  double amplitude_db_ = 0.0;
};

}  // namespace trident::sim
