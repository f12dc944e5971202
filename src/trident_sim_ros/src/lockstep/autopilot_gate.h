// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "loss_watch.h"
#include "trident_sim/outside_autopilots.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// Holds steps back until the outside autopilots (PX4, ArduPilot) have answered the step before:
/// all were asked together, and are waited for together. By the stepping thread, with the world's
/// mutex held.
class AutopilotGate {
 public:
  /// Both must outlive it.
  AutopilotGate(World& world, LossWatch& losses)
      : autopilots_(world.extensions().get<OutsideAutopilots>(world)), losses_(losses) {}

  /// True: the step may be made. False: it has waited for up to a millisecond; look again.
  bool allows_step(SimTime now);
  /// Takes what comes while no step is to be made: connections, for one.
  void poll();

 private:
  void check_silence(OutsideAutopilot& autopilot, SimTime now);
  void note_free_ones(SimTime now);

  OutsideAutopilots& autopilots_;
  LossWatch& losses_;
  std::map<std::string, Waiting> waiting_;  ///< by OutsideAutopilot::who()
};

}  // namespace trident::sim
