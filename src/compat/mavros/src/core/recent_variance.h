// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <numeric>

namespace trident::mavros {

/// Variance of the newest 50 values about their mean.
class RecentVariance {
 public:
  /// Adds a finite value, in place of the oldest one; the variance with it.
  double add(double value) {
    values_[next_] = value;
    next_ = (next_ + 1) % kCount;
    if (count_ < kCount) ++count_;
    const auto end = values_.begin() + static_cast<std::ptrdiff_t>(count_);
    const double mean = std::accumulate(values_.begin(), end, 0.0) / static_cast<double>(count_);
    const auto add_square = [mean](double sum, double one) {
      return sum + (one - mean) * (one - mean);
    };
    return std::accumulate(values_.begin(), end, 0.0, add_square) / static_cast<double>(count_);
  }

 private:
  static constexpr std::size_t kCount = 50;
  std::array<double, kCount> values_{};
  std::size_t next_ = 0, count_ = 0;
};

}  // namespace trident::mavros
