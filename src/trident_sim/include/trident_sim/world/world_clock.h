// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// Simulated time and the count of steps. Only the world advances it.
class WorldClock {
 public:
  /// Of the current state: step_count() steps after the last reset(), unless the step size changed.
  SimTime time() const { return time_; }
  /// Number of steps since the world began or reset() was called; reset_models() does not change
  /// it.
  std::uint64_t step_count() const { return step_count_; }
  SimTime dt() const { return dt_; }  ///< of the next step

 protected:
  WorldClock() = default;
  ~WorldClock() = default;

  SimTime time_, dt_;
  std::uint64_t step_count_ = 0;
  std::uint64_t reset_step_ = 0;  ///< step count of the last reset of the models
};

}  // namespace trident::sim
