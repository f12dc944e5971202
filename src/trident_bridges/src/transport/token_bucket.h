// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace trident::bridges {

/// Limits a rate: tokens come at `rate` and wait in a bucket that holds those of one second, at
/// least one; each event takes one. So what a process did not read during a pause is not limited.
class TokenBucket {
 public:
  /// `rate` [1/s] > 0; the bucket is full at first.
  explicit TokenBucket(double rate)
      : rate_(rate), size_(std::max(kBurst_s * rate, 1.0)), tokens_(size_) {}

  /// Takes a token; false when there is no whole one. `now_s` must not decrease [s].
  bool take(double now_s) {
    if (now_s > filled_s_) {
      tokens_ = std::min(size_, tokens_ + rate_ * (now_s - filled_s_));
      filled_s_ = now_s;
    }
    if (tokens_ < 1.0) return false;
    tokens_ -= 1.0;
    return true;
  }

 private:
  static constexpr double kBurst_s = 1.0;
  double rate_, size_, tokens_;
  double filled_s_ = 0.0;
};

}  // namespace trident::bridges
