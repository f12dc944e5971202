// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace trident::slam {

// Dense parts of the sparse Cholesky factorisation. Matrices are column-major. Every element is the
// same sequence of rounded operations whatever instructions the processor has, so results are equal
// to the bit.
//
// Kernels take rows four at a time: they read and write up to kRowPadding rows beyond the last one
// of a column, whose values do not matter, so leading dimensions are at least rows + kRowPadding.
constexpr std::ptrdiff_t kRowPadding = 3;

/// The least leading dimension for this number of rows.
constexpr std::ptrdiff_t padded_rows(std::ptrdiff_t rows) {
  return (rows + kRowPadding + 3) / 4 * 4;
}

/// The lower triangle of C (n x n, leading dimension ldc) -= A * A', A being n x depth with leading
/// dimension lda. What is above the diagonal is left undefined. `strip`: 2 or 3, which divides n.
void subtract_outer_product(double* C, std::ptrdiff_t ldc, const double* A, std::ptrdiff_t lda,
                            std::ptrdiff_t n, std::ptrdiff_t depth, int strip);

/// Cholesky factorisation of the first `columns` columns of a tall matrix of `rows` rows, in place:
/// the lower triangle L11 on top, L21 = A21 * L11^-T below. Diagonal elements become their
/// reciprocals. False when a pivot is not > 0. `strip`: 2 or 3, which divides `columns`.
bool factorize_panel(double* panel, std::ptrdiff_t ld, std::ptrdiff_t rows, std::ptrdiff_t columns,
                     int strip);

/// Only two numbers at a time, as processors without AVX2 do it; for tests.
void force_plain_kernels(bool is_forced);

}  // namespace trident::slam
