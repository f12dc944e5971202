// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace trident::sim {

// Elementary functions of several waves at once, without branches, so that they become vector
// instructions. Sums over waves are what a sea costs.

/// Eight waves side by side.
using WaveLanes = Eigen::Array<double, 8, 1>;

struct SineCosine {
  WaveLanes sine, cosine;
};

/// Within 1e-12 for angles up to 1e6.
inline SineCosine sine_cosine(const WaveLanes& angle) {
  // Adding and taking away 1.5 * 2^52 rounds to a whole number.
  constexpr double kRound = 6755399441055744.0;
  // 2 pi in two parts, the first short enough for exact products with whole numbers below 2^20.
  constexpr double kTurn = 6.2831853069365025, kTurnRest = 2.430840202602477e-10;
  const WaveLanes turns = (angle * (1.0 / (kTurn + kTurnRest)) + kRound) - kRound;
  // A quarter of the angle lies in [-pi/4, pi/4], where the series are short.
  const WaveLanes x = 0.25 * ((angle - turns * kTurn) - turns * kTurnRest);
  const WaveLanes y = x * x;
  WaveLanes s =
      x * (1.0 + y * (-1.0 / 6 +
                      y * (1.0 / 120 +
                           y * (-1.0 / 5040 + y * (1.0 / 362880 + y * (-1.0 / 39916800 +
                                                                       y * (1.0 / 6227020800)))))));
  WaveLanes c =
      1.0 +
      y * (-0.5 + y * (1.0 / 24 +
                       y * (-1.0 / 720 + y * (1.0 / 40320 + y * (-1.0 / 3628800 +
                                                                 y * (1.0 / 479001600 -
                                                                      y * (1.0 / 87178291200)))))));
  for (int i = 0; i < 2; ++i) {
    const WaveLanes doubled = 2.0 * s * c;
    c = 1.0 - 2.0 * s * s;
    s = doubled;
  }
  return {s, c};
}

/// exp(-x) for x >= 0, relatively within 1e-12; beyond 40 as at 40.
inline WaveLanes decaying(const WaveLanes& x) {
  const WaveLanes y = x.min(40.0) * (-1.0 / 1024);
  WaveLanes e =
      1.0 +
      y * (1.0 +
           y * (0.5 + y * (1.0 / 6 +
                           y * (1.0 / 24 + y * (1.0 / 120 + y * (1.0 / 720 + y * (1.0 / 5040)))))));
  for (int i = 0; i < 10; ++i) e *= e;
  return e;
}

}  // namespace trident::sim
