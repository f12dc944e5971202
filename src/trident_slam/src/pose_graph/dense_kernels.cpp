// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "dense_kernels.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace trident::slam {
namespace {

#define TRIDENT_INLINE inline __attribute__((always_inline))

// GCC's and clang's vectors; memcpy is how they are loaded from where they are not aligned.
typedef double Vector2 __attribute__((vector_size(16)));
typedef double Vector4 __attribute__((vector_size(32)));

// C (kVectors vectors of rows x kColumns) -= A * B', over `depth` columns of A and B. The sum is
// formed first, in the order of the columns.
template <class Vector, int kVectors, int kColumns>
TRIDENT_INLINE void update_tile(double* C, std::ptrdiff_t ldc, const double* A, const double* B,
                                std::ptrdiff_t ld, std::ptrdiff_t depth) {
  constexpr int kWidth = sizeof(Vector) / sizeof(double);
  Vector sum[kColumns][kVectors] = {};
  for (std::ptrdiff_t k = 0; k < depth; ++k, A += ld, B += ld) {
    Vector a[kVectors];
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) __builtin_memcpy(&a[v], A + v * kWidth, sizeof(Vector));
#pragma GCC unroll 8
    for (int c = 0; c < kColumns; ++c) {
#pragma GCC unroll 4
      for (int v = 0; v < kVectors; ++v) sum[c][v] += a[v] * B[c];
    }
  }
#pragma GCC unroll 8
  for (int c = 0; c < kColumns; ++c) {
#pragma GCC unroll 4
    for (int v = 0; v < kVectors; ++v) {
      Vector value;
      __builtin_memcpy(&value, C + c * ldc + v * kWidth, sizeof(Vector));
      value -= sum[c][v];
      __builtin_memcpy(C + c * ldc + v * kWidth, &value, sizeof(Vector));
    }
  }
}

// Rows of one strip of columns: C (rows x kColumns) -= A * B'.
template <class Vector, int kColumns>
TRIDENT_INLINE void update_strip(double* C, std::ptrdiff_t ldc, const double* A, const double* B,
                                 std::ptrdiff_t ld, std::ptrdiff_t rows, std::ptrdiff_t depth) {
  constexpr int kWidth = sizeof(Vector) / sizeof(double);
  std::ptrdiff_t row = 0;
  for (; row + kWidth < rows; row += 2 * kWidth) {
    update_tile<Vector, 2, kColumns>(C + row, ldc, A + row, B, ld, depth);
  }
  if (row < rows) update_tile<Vector, 1, kColumns>(C + row, ldc, A + row, B, ld, depth);
}

// C(i, j) -= A(i, :) * B(j, :)' for the columns [0, columns) and rows from the column's on.
template <class Vector, int kColumns>
TRIDENT_INLINE void update_trapezoid(double* C, std::ptrdiff_t ldc, const double* A,
                                     std::ptrdiff_t ld, std::ptrdiff_t rows, std::ptrdiff_t columns,
                                     std::ptrdiff_t depth) {
  std::ptrdiff_t column = 0;
  if (kColumns == 3) {  // twice as wide strips read A half as often
    for (; column + 6 <= columns; column += 6) {
      update_strip<Vector, 6>(C + column * ldc + column, ldc, A + column, A + column, ld,
                              rows - column, depth);
    }
  }
  for (; column < columns; column += kColumns) {
    update_strip<Vector, kColumns>(C + column * ldc + column, ldc, A + column, A + column, ld,
                                   rows - column, depth);
  }
}

using Update = void (*)(double*, std::ptrdiff_t, const double*, std::ptrdiff_t, std::ptrdiff_t,
                        std::ptrdiff_t, std::ptrdiff_t);

template <int kColumns>
void update_plain(double* C, std::ptrdiff_t ldc, const double* A, std::ptrdiff_t ld,
                  std::ptrdiff_t rows, std::ptrdiff_t columns, std::ptrdiff_t depth) {
  update_trapezoid<Vector2, kColumns>(C, ldc, A, ld, rows, columns, depth);
}

#if defined(__x86_64__)
// Four lanes instead of two; without FMA the roundings are the same ones.
template <int kColumns>
__attribute__((target("avx2"))) void update_avx2(double* C, std::ptrdiff_t ldc, const double* A,
                                                 std::ptrdiff_t ld, std::ptrdiff_t rows,
                                                 std::ptrdiff_t columns, std::ptrdiff_t depth) {
  update_trapezoid<Vector4, kColumns>(C, ldc, A, ld, rows, columns, depth);
}
#endif

bool has_four_lanes() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

std::atomic<bool> is_plain{!has_four_lanes()};

template <int kColumns>
Update update_of_strips() {
#if defined(__x86_64__)
  if (!is_plain) return update_avx2<kColumns>;
#endif
  return update_plain<kColumns>;
}

Update update_for(int strip) { return strip == 2 ? update_of_strips<2>() : update_of_strips<3>(); }

// Cholesky of one strip of columns whose earlier columns are already subtracted.
bool factorize_strip(double* strip, std::ptrdiff_t ld, std::ptrdiff_t rows, int columns) {
  for (int c = 0; c < columns; ++c) {
    double* column = strip + c * ld;
    for (int before = 0; before < c; ++before) {
      const double* other = strip + before * ld;
      const double factor = other[c];
      for (std::ptrdiff_t row = c; row < rows; ++row) column[row] -= other[row] * factor;
    }
    if (!(column[c] > 0.0)) return false;
    const double reciprocal = 1.0 / std::sqrt(column[c]);
    column[c] = reciprocal;
    for (std::ptrdiff_t row = c + 1; row < rows; ++row) column[row] *= reciprocal;
  }
  return true;
}

}  // namespace

void force_plain_kernels(bool is_forced) { is_plain = is_forced || !has_four_lanes(); }

void subtract_outer_product(double* C, std::ptrdiff_t ldc, const double* A, std::ptrdiff_t lda,
                            std::ptrdiff_t n, std::ptrdiff_t depth, int strip) {
  update_for(strip)(C, ldc, A, lda, n, n, depth);
}

bool factorize_panel(double* panel, std::ptrdiff_t ld, std::ptrdiff_t rows, std::ptrdiff_t columns,
                     int strip) {
  constexpr std::ptrdiff_t kBlock = 48;  // of columns: what is read again stays in the cache
  const Update update = update_for(strip);
  for (std::ptrdiff_t begin = 0; begin < columns; begin += kBlock) {
    const std::ptrdiff_t end = std::min(columns, begin + kBlock);
    for (std::ptrdiff_t column = begin; column < end; column += strip) {
      double* diagonal = panel + column * ld + column;
      update(diagonal, ld, panel + begin * ld + column, ld, rows - column, strip, column - begin);
      if (!factorize_strip(diagonal, ld, rows - column, strip)) return false;
    }
    update(panel + end * ld + end, ld, panel + begin * ld + end, ld, rows - end, columns - end,
           end - begin);
  }
  return true;
}

}  // namespace trident::slam
