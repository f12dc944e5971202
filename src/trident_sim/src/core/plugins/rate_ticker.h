// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_sim/plugin.h"
#include "trident_sim/state_archive.h"

namespace trident::sim {

/// Divides time into periods: due once a period, beginning one period after a reset.
class RateTicker {
 public:
  /// 0: due at every step.
  explicit RateTicker(double rate_hz);
  bool tick(const StepInfo& info);
  void reset() { elapsed_ = {}; }
  void state(StateArchive& archive) { archive(elapsed_); }

 private:
  SimTime period_, elapsed_;
};

}  // namespace trident::sim
