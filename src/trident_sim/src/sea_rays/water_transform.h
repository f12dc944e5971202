// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace trident::sim {

/// A square of complex numbers, rows one after another.
struct ComplexGrid {
  explicit ComplexGrid(std::size_t side)
      : n(side), re(side * side), im(side * side), column_is_used(side, 1) {}
  std::size_t n;
  std::vector<float> re, im;
  std::vector<char> column_is_used;  ///< 0: all of it is zero, as most of a spectrum is
};

/// Inverse discrete Fourier transform along both indices, without a factor:
///   x[j][l] = sum over p, q of X[p][q] exp(2 pi i (j p + l q) / n).
/// Radix 2, the columns of a strip side by side, so that butterflies become vector instructions.
class WaterTransform {
 public:
  /// `n` is a power of two, at least 16.
  explicit WaterTransform(std::size_t n);
  void operator()(ComplexGrid& grid);

 private:
  static constexpr std::size_t kStrip = 16;  ///< columns that are transformed at a time
  void transform_columns(const ComplexGrid& in, ComplexGrid& transposed);
  void load_strip(const ComplexGrid& in, std::size_t column);
  void butterflies();

  std::size_t n_;
  std::vector<std::size_t> reversed_;  ///< bits of an index, back to front
  std::vector<float> cosine_, sine_;   ///< of 2 pi k / n, for k < n / 2
  std::vector<float> strip_re_, strip_im_;
  ComplexGrid turned_;
};

}  // namespace trident::sim
