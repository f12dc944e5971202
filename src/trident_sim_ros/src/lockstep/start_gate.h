// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "run/server_options.h"
#include "topics/port_binder.h"
#include "trident_base/mutex.h"
#include "trident_sim/world.h"
#include "vehicle_table.h"

namespace trident::sim {

/// Holds time zero until everything that was declared is there. Once it is released, it stays so.
class StartGate {
 public:
  /// All arguments must outlive it.
  StartGate(const ServerOptions& options, VehicleTable& vehicles, Repeatability& repeatability)
      : options_(options), vehicles_(vehicles), repeatability_(repeatability) {}

  /// True when time may run; enrols the controllers when it is released.
  bool allows_start(const World& world, PortBinder& binder);
  /// What time zero is held for, in words; "" when nothing is missing.
  std::string missing(const World& world);
  /// True while time zero is held for something.
  bool is_held() const { return options_.holds_time_zero() && !is_released_; }
  /// Time zero has been left, or is about to be.
  bool is_released() const { return is_released_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// Names the vehicles without controllers among those whose port `is_asked` is true for.
  template <class IsAsked>
  void add_missing_controllers(const IsAsked& is_asked, std::vector<std::string>& missing) const;
  bool is_to_be_controlled(const std::string& port) const;
  bool all_announced_confirm();
  void release(const World& world);

  const ServerOptions& options_;
  VehicleTable& vehicles_;
  Repeatability& repeatability_;
  bool is_released_ = false;
  Clock::time_point next_master_poll_;  ///< For controllers that will confirm set-points.
};

}  // namespace trident::sim
