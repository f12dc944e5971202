// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "trident_sim/world/step_extension.h"

namespace trident::sim {

class World;

/// An autopilot program outside of the simulator (PX4, ArduPilot) that a plugin talks to, and that
/// steps wait for. All calls are made by the stepping thread. That of the server waits between
/// steps, so that a pause, a service and the end of the run are not held up; in a world without a
/// server the plugin itself waits as the step begins.
class OutsideAutopilot {
 public:
  virtual ~OutsideAutopilot() = default;
  /// The vehicle, the program and the address: "model 'iris': PX4 at tcp 127.0.0.1:4560".
  virtual std::string who() const = 0;
  /// After the last sensor of a step has measured: sends what is due.
  virtual void send_sensors() = 0;
  /// Whether the next step needs something that has not come.
  virtual bool is_awaited() const = 0;
  /// What that is, as a predicate of who(): "has not answered the sensors of t = 1.004 s".
  virtual std::string awaited() const = 0;
  /// Its connection has ended, and has not been made again.
  virtual bool is_gone() const = 0;
  /// It has connected, and is not waited for, as it has never answered or is not in lockstep: how
  /// far it gets by when is left to chance.
  virtual bool runs_free() const = 0;
  /// Takes what has come; waits for it for up to `timeout_s` of wall time, or until anything comes
  /// for any of those that share a poll loop.
  virtual void receive(double timeout_s) = 0;
  /// The world continues without it, until it connects, or answers, again.
  virtual void give_up() = 0;
};

/// All outside autopilots of a world, each added and removed by its plugin. They are asked together
/// as a step ends, and waited for together before the next one, so that they compute side by side.
class OutsideAutopilots : public StepExtension {
 public:
  /// One for each world: world.extensions().get<OutsideAutopilots>(world).
  explicit OutsideAutopilots(World& /*world*/) {}

  /// `autopilot` must be removed before it dies.
  void add(OutsideAutopilot& autopilot) { all_.push_back(&autopilot); }
  /// Unknown ones are ignored.
  void remove(const OutsideAutopilot& autopilot) {
    all_.erase(std::remove(all_.begin(), all_.end(), &autopilot), all_.end());
  }
  /// In the order in which they were added.
  const std::vector<OutsideAutopilot*>& all() const { return all_; }
  /// The first one that the next step needs something of; nullptr: the step may be made.
  OutsideAutopilot* first_awaited() const {
    for (OutsideAutopilot* autopilot : all_) {
      if (autopilot->is_awaited()) return autopilot;
    }
    return nullptr;
  }

  void begin_steps() override {}
  void end_phase(Phase phase) override {
    if (phase != Phase::kPost) return;
    for (OutsideAutopilot* autopilot : all_) autopilot->send_sensors();
  }

 private:
  std::vector<OutsideAutopilot*> all_;
};

}  // namespace trident::sim
