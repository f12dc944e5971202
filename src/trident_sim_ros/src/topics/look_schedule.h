// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// When to look again for what changes seldom and costs locks of roscpp: after 50 ms, or after a
/// second of simulated time in a world that is faster.
class LookSchedule {
 public:
  /// True: it is time, and the next time is counted from now.
  bool is_due(SimTime now) {
    const auto wall = std::chrono::steady_clock::now();
    const bool has_passed = now < looked_ || now - looked_ >= SimTime{1'000'000'000};
    if (!has_passed && wall - looked_wall_ < std::chrono::milliseconds(50)) return false;
    looked_ = now;
    looked_wall_ = wall;
    return true;
  }

 private:
  SimTime looked_;
  std::chrono::steady_clock::time_point looked_wall_;
};

}  // namespace trident::sim
