// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "water_transform.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "trident_base/angle.h"

namespace trident::sim {

WaterTransform::WaterTransform(std::size_t n)
    : n_(n),
      reversed_(n),
      cosine_(n / 2),
      sine_(n / 2),
      strip_re_(n * kStrip),
      strip_im_(n * kStrip),
      turned_(n) {
  // Indices with their bits in reverse, by adding one from the highest bit down.
  for (std::size_t i = 1, reversed = 0; i < n; ++i) {
    std::size_t bit = n / 2;
    for (; (reversed & bit) != 0; bit /= 2) reversed ^= bit;
    reversed |= bit;
    reversed_[i] = reversed;
  }
  for (std::size_t k = 0; k < n / 2; ++k) {
    const double angle = 2.0 * kPi * static_cast<double>(k) / static_cast<double>(n);
    cosine_[k] = static_cast<float>(std::cos(angle));
    sine_[k] = static_cast<float>(std::sin(angle));
  }
}

void WaterTransform::operator()(ComplexGrid& grid) {
  // Columns, transposed, and columns again: the second pass does the rows and turns the grid back.
  transform_columns(grid, turned_);
  transform_columns(turned_, grid);
}

void WaterTransform::transform_columns(const ComplexGrid& in, ComplexGrid& transposed) {
  for (std::size_t column = 0; column < n_; column += kStrip) {
    float* const re = &transposed.re[column * n_];
    float* const im = &transposed.im[column * n_];
    const auto used = in.column_is_used.begin() + static_cast<std::ptrdiff_t>(column);
    // A sea's spectrum fills few of the wave numbers, so that whole strips are zero.
    if (std::all_of(used, used + kStrip, [](char is_used) { return is_used == 0; })) {
      std::fill_n(re, kStrip * n_, 0.0F);
      std::fill_n(im, kStrip * n_, 0.0F);
      continue;
    }
    load_strip(in, column);
    butterflies();
    for (std::size_t i = 0; i < kStrip; ++i) {
      for (std::size_t row = 0; row < n_; ++row) re[i * n_ + row] = strip_re_[row * kStrip + i];
      for (std::size_t row = 0; row < n_; ++row) im[i * n_ + row] = strip_im_[row * kStrip + i];
    }
  }
}

/// Rows in the order that the butterflies want.
void WaterTransform::load_strip(const ComplexGrid& in, std::size_t column) {
  for (std::size_t row = 0; row < n_; ++row) {
    const std::size_t from = reversed_[row] * n_ + column, to = row * kStrip;
    for (std::size_t i = 0; i < kStrip; ++i) {
      strip_re_[to + i] = in.re[from + i];
      strip_im_[to + i] = in.im[from + i];
    }
  }
}

/// Radix-2 decimation in time (Cooley and Tukey), on the columns of a strip side by side.
void WaterTransform::butterflies() {
  for (std::size_t half = 1; half < n_; half *= 2) {
    for (std::size_t k = 0; k < half; ++k) {
      const float c = cosine_[k * (n_ / (2 * half))], s = sine_[k * (n_ / (2 * half))];
      for (std::size_t first = k; first < n_; first += 2 * half) {
        float* const a_re = &strip_re_[first * kStrip];
        float* const a_im = &strip_im_[first * kStrip];
        float* const b_re = &strip_re_[(first + half) * kStrip];
        float* const b_im = &strip_im_[(first + half) * kStrip];
        for (std::size_t i = 0; i < kStrip; ++i) {
          const float re = c * b_re[i] - s * b_im[i], im = c * b_im[i] + s * b_re[i];
          b_re[i] = a_re[i] - re;
          b_im[i] = a_im[i] - im;
          a_re[i] += re;
          a_im[i] += im;
        }
      }
    }
  }
}

}  // namespace trident::sim
