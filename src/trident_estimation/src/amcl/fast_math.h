// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

// Functions of single precision without branches or calls, so that loops over particles become
// vector instructions, which are the same on every machine.

namespace trident::estimation::fast {

inline constexpr float kRoundingBias =
    12582912.0F;  // 1.5 * 2^23: adding it rounds to whole numbers

/// The nearest whole number, for |x| < 2^22.
inline float rounded(float x) { return (x + kRoundingBias) - kRoundingBias; }

/// The same angle in [-pi, pi], for some thousand turns at most.
inline float wrapped(float angle) {
  const float turns = rounded(angle * 0.15915494309F);
  return (angle - turns * 6.28125F) - turns * 1.9353071796e-3F;
}

/// Sine and cosine within 3e-7 for |angle| of some turns: reduction to a quarter about an axis,
/// then Taylor's polynomials with coefficients fitted to it (those of Cephes, S. Moshier).
inline void sine_cosine(float angle, float* sine, float* cosine) {
  const float quarter = rounded(angle * 0.63661977237F);
  const float r = ((angle - quarter * 1.5703125F) - quarter * 4.8375129699707e-4F) -
                  quarter * 7.5497899548918e-8F;
  const float square = r * r;
  const float s =
      r +
      r * square * (-1.6666654611e-1F + square * (8.3321608736e-3F + square * -1.9515295891e-4F));
  const float c = 1.0F - 0.5F * square +
                  square * square *
                      (4.166664568298827e-2F +
                       square * (-1.388731625493765e-3F + square * 2.443315711809948e-5F));
  const auto turn = static_cast<std::int32_t>(quarter);
  const bool is_swapped = (turn & 1) != 0;
  const float a = is_swapped ? c : s, b = is_swapped ? s : c;
  *sine = (turn & 2) != 0 ? -a : a;
  *cosine = ((turn + 1) & 2) != 0 ? -b : b;
}

/// Of `count` angles.
inline void sines_cosines(const float* angles, std::size_t count, float* sines, float* cosines) {
  for (std::size_t i = 0; i < count; ++i) sine_cosine(angles[i], &sines[i], &cosines[i]);
}

}  // namespace trident::estimation::fast
