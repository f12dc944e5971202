// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Loops over kLanes trajectories at once. Plain C++ that compilers turn into vector instructions;
// where the processor has AVX2, a second copy of the same loops is used that was compiled for it.
// All operations are per lane and none is contracted, so that both give the same bits.

#define TRIDENT_INLINE inline __attribute__((always_inline))
#define TRIDENT_LANES __attribute__((always_inline))

namespace trident::nav {

constexpr int kLanes = 32;

/// True if the loops run on AVX2.
bool has_wide_lanes();
/// For tests: without AVX2 even where the processor has it.
void force_plain_lanes(bool is_forced);

template <class Kernel>
__attribute__((noinline)) void run_plain(const Kernel& kernel) {
  kernel();
}

#if defined(__x86_64__)
template <class Kernel>
__attribute__((noinline, target("avx2"))) void run_avx2(const Kernel& kernel) {
  kernel();
}
#endif

/// Calls a kernel, `[&]() TRIDENT_LANES { ... }`, whose functions are all TRIDENT_INLINE.
template <class Kernel>
void run_lanes(const Kernel& kernel) {
#if defined(__x86_64__)
  if (has_wide_lanes()) return run_avx2(kernel);
#endif
  run_plain(kernel);
}

TRIDENT_INLINE float least(float a, float b) { return a < b ? a : b; }
TRIDENT_INLINE float greatest(float a, float b) { return a > b ? a : b; }
TRIDENT_INLINE float clamped(float value, float lo, float hi) {
  return least(greatest(value, lo), hi);
}
TRIDENT_INLINE float absolute(float value) { return value < 0.0F ? -value : value; }

/// Cosine and sine of small angles, to 1e-7 for |angle| <= 0.5 (Taylor).
TRIDENT_INLINE float small_cosine(float angle) {
  const float square = angle * angle;
  return 1.0F - square * (0.5F - square * (1.0F / 24.0F - square * (1.0F / 720.0F)));
}
TRIDENT_INLINE float small_sine(float angle) {
  const float square = angle * angle;
  return angle * (1.0F - square * (1.0F / 6.0F - square * (1.0F / 120.0F - square / 5040.0F)));
}

/// |atan2(y, x)| to 2e-4 rad: polynomial of Abramowitz and Stegun 4.4.49 on the octant.
TRIDENT_INLINE float absolute_angle(float y, float x) {
  const float ay = absolute(y);
  const float ax = absolute(x);
  const float larger = greatest(greatest(ax, ay), 1e-20F);
  const float ratio = least(ax, ay) / larger;
  const float square = ratio * ratio;
  const float low =
      ratio * (0.9998660F +
               square * (-0.3302995F +
                         square * (0.1801410F + square * (-0.0851330F + square * 0.0208351F))));
  const float octant = ay > ax ? 1.57079633F - low : low;
  return x < 0.0F ? 3.14159265F - octant : octant;
}

}  // namespace trident::nav
