// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "loss_watch.h"
#include "node_probe.h"
#include "trident_base/mutex.h"
#include "trident_sim/world.h"
#include "vehicle_link.h"

namespace trident::sim {

/// Looks which controllers and set-point sources the world waits for, and what LossWatch has to say
/// about each. Takes the hub's mutex itself.
class TimeoutCheck {
 public:
  /// All arguments must outlive it.
  TimeoutCheck(LockstepHub& hub, LossWatch& losses, NodeProbe& probe)
      : hub_(hub), losses_(losses), probe_(probe) {}

  /// While time zero is held: a controller or source that was there and has died will not come by
  /// waiting.
  void check_at_start() TRIDENT_EXCLUDES(hub_.mutex);
  /// After a step could not be made: each node that is late is reported, and released when it is
  /// given up.
  void check(const World& world) TRIDENT_EXCLUDES(hub_.mutex);
  /// Nobody is waited for.
  void clear() { sources_.clear(); }

 private:
  void check_controllers_at_start(WallTime now) TRIDENT_REQUIRES(hub_.mutex);
  void check_sources_at_start(WallTime now) TRIDENT_REQUIRES(hub_.mutex);
  void check_vehicle(VehicleLink& vehicle, WallTime now) TRIDENT_REQUIRES(hub_.mutex);
  void check_source(SimTime time, WallTime now) TRIDENT_REQUIRES(hub_.mutex);

  LockstepHub& hub_;
  LossWatch& losses_;
  NodeProbe& probe_;
  std::map<std::string, Waiting> sources_;  ///< How long the world waits for them.
};

}  // namespace trident::sim
