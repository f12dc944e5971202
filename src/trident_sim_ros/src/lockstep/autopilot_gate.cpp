// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "autopilot_gate.h"

namespace trident::sim {
namespace {

constexpr double kWait_s = 0.001;  ///< with the world's mutex held, which services may want

}  // namespace

bool AutopilotGate::allows_step(SimTime now) {
  OutsideAutopilot* awaited = autopilots_.first_awaited();
  if (awaited == nullptr) {
    if (!autopilots_.all().empty()) note_free_ones(now);
    return true;
  }
  awaited->receive(kWait_s);
  bool is_complete = true;
  for (OutsideAutopilot* autopilot : autopilots_.all()) {
    if (!autopilot->is_awaited()) {
      if (!waiting_.empty()) waiting_.erase(autopilot->who());
      continue;
    }
    check_silence(*autopilot, now);
    is_complete = is_complete && !autopilot->is_awaited();
  }
  if (!is_complete) return false;
  losses_.clear();
  note_free_ones(now);
  return true;
}

void AutopilotGate::poll() {
  for (OutsideAutopilot* autopilot : autopilots_.all()) autopilot->receive(0.0);
}

void AutopilotGate::check_silence(OutsideAutopilot& autopilot, SimTime now) {
  const WallTime wall = wall_now();
  Waiting& waiting = waiting_[autopilot.who()];
  if (waiting.since == 0) waiting.since = wall;
  const LossWatch::Silence silence{autopilot.who(), autopilot.awaited(), autopilot.is_gone(), 1.0,
                                   now};
  if (!losses_.gives_up(silence, waiting, wall)) return;
  autopilot.give_up();
  waiting_.erase(autopilot.who());
}

/// Those that are there and not waited for: what they do when, the wall clock decides.
void AutopilotGate::note_free_ones(SimTime now) {
  for (const OutsideAutopilot* autopilot : autopilots_.all()) {
    if (!autopilot->runs_free()) continue;
    losses_.repeatability().spoil(
        autopilot->who(), now, "is not waited for: when its answers come, the wall clock decides");
  }
}

}  // namespace trident::sim
