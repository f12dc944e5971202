// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace trident::sim {

/// How often a refusal is reported that comes again and again: the first ten times, then each time
/// that their number has doubled. A user who tries things out reads of each mistake, a publisher
/// gone mad fills no log.
class ReportThrottle {
 public:
  /// Counts one more; returns whether it is to be reported.
  bool is_due() {
    ++count_;
    return count_ <= kAlways || (count_ & (count_ - 1)) == 0;
  }

 private:
  static constexpr std::uint64_t kAlways = 10;
  std::uint64_t count_ = 0;
};

}  // namespace trident::sim
