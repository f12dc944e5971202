// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "trident_sim/plugin.h"

namespace trident::sim {

/// Decides at which steps a sensor of some rate measures. Sample k is due at k / rate after the
/// last reset, k >= 1, and taken by the first step that ends there or later: on time when the
/// period is a whole number of steps, else up to a step late, without drift. A rate of zero, or
/// above one sample per step, means every step.
class SampleClock {
 public:
  explicit SampleClock(double rate_hz) : rate_hz_(rate_hz) {}

  double rate_hz() const { return rate_hz_; }
  /// Number of the newest sample that is due by the end of a step.
  std::uint64_t count_at(const StepInfo& info) const {
    if (rate_hz_ <= 0.0 || rate_hz_ * info.dt_s >= 1.0) return info.sample;
    const double elapsed_s = static_cast<double>(info.dt.ns * info.sample) / 1e9;
    return static_cast<std::uint64_t>(std::floor(elapsed_s * rate_hz_ * (1.0 + kRounding)));
  }
  /// Whether a sample is due in this step, and which.
  bool is_due(const StepInfo& info) const {
    if (info.sample == 0) return false;
    StepInfo before = info;
    --before.sample;
    return count_at(info) != count_at(before);
  }

 private:
  static constexpr double kRounding = 1e-12;  ///< 0.3 s times 10 Hz is three samples
  double rate_hz_;
};

}  // namespace trident::sim
