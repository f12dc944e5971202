// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "square_kernel.h"

#include <algorithm>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace trident::nav {
namespace {

#if defined(__x86_64__)

__m128i least(__m128i a, __m128i b) { return _mm_sub_epi16(a, _mm_subs_epu16(a, b)); }

__m128i load(const std::uint16_t* p) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
}

/// Eight results. Nothing beyond a column whose square alone exceeds all results can lower one.
__m128i row_sse2(const std::uint16_t* center, int reach, std::uint16_t beyond) {
  __m128i best = least(_mm_set1_epi16(static_cast<short>(beyond)), load(center));
  for (int dx = 1; dx <= reach; ++dx) {
    const __m128i square = _mm_set1_epi16(static_cast<short>(dx * dx));
    const __m128i side = least(load(center - dx), load(center + dx));
    best = least(best, _mm_adds_epu16(side, square));
    if (dx % 8 == 0 && _mm_movemask_epi8(_mm_cmpeq_epi16(_mm_subs_epu16(best, square),
                                                         _mm_setzero_si128())) == 0xffff) {
      break;
    }
  }
  return best;
}

void run_sse2(const std::uint16_t* squares, int count, int reach, std::uint16_t beyond,
              std::uint16_t* result) {
  for (int i = 0; i < count; i += 8) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(result + i),
                     row_sse2(squares + i + reach, reach, beyond));
  }
}

__attribute__((target("avx2"))) __m256i load_avx2(const std::uint16_t* p) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
}

__attribute__((target("avx2"))) void run_avx2(const std::uint16_t* squares, int count, int reach,
                                              std::uint16_t beyond, std::uint16_t* result) {
  for (int i = 0; i < count; i += 16) {
    const std::uint16_t* center = squares + i + reach;
    __m256i best =
        _mm256_min_epu16(_mm256_set1_epi16(static_cast<short>(beyond)), load_avx2(center));
    for (int dx = 1; dx <= reach; ++dx) {
      const __m256i square = _mm256_set1_epi16(static_cast<short>(dx * dx));
      const __m256i side = _mm256_min_epu16(load_avx2(center - dx), load_avx2(center + dx));
      best = _mm256_min_epu16(best, _mm256_adds_epu16(side, square));
      if (dx % 8 == 0 &&
          _mm256_testz_si256(_mm256_subs_epu16(best, square), _mm256_set1_epi16(-1)) != 0) {
        break;
      }
    }
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(result + i), best);
  }
}

using RowFunction = void (*)(const std::uint16_t*, int, int, std::uint16_t, std::uint16_t*);
const RowFunction run_row = __builtin_cpu_supports("avx2") != 0 ? run_avx2 : run_sse2;

#else

void run_row(const std::uint16_t* squares, int count, int reach, std::uint16_t beyond,
             std::uint16_t* result) {
  for (int i = 0; i < count; ++i) {
    int best = beyond;
    for (int dx = -reach; dx <= reach; ++dx) {
      best = std::min(best, squares[i + reach + dx] + dx * dx);
    }
    result[i] = static_cast<std::uint16_t>(best);
  }
}

#endif

}  // namespace

void least_squares_in_row(const std::uint16_t* squares, int count, int reach, std::uint16_t beyond,
                          std::uint16_t* result) {
  run_row(squares, count, reach, beyond, result);
}

}  // namespace trident::nav
