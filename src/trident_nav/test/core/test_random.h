// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "trident_base/random_stream.h"

namespace trident::nav {

/// Numbers of one stream in turn.
class TestRandom {
 public:
  explicit TestRandom(std::uint64_t seed) : stream_(seed, "test") {}
  /// In [0, 1).
  double uniform() { return stream_.uniform(next_++, 0); }
  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// In [0, count).
  int below(int count) { return static_cast<int>(uniform() * count); }

 private:
  RandomStream stream_;
  std::uint64_t next_ = 0;
};

}  // namespace trident::nav
