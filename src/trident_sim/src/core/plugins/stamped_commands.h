// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>

#include "plugin_util.h"

namespace trident::sim {

/// Commands of an external controller on a topic, each at its time: in `rotors` timing the answer
/// to the odometry stamped s acts in the step that begins at s + dt, in `direct` timing in the one
/// that begins at s. The stamp decides, never the moment of arrival, so a run can be repeated.
class StampedCommands {
 public:
  StampedCommands(const PluginContext& context, const std::string& topic)
      : delayed_(context.world.timing() == LoopTiming::kRotors),
        port_(subscribe<ActuatorCommand>(context, topic)) {}

  /// The latest command that is due and was not taken yet, older ones are dropped; or nullptr.
  const ActuatorCommand* take_due(const StepInfo& info) {
    const ActuatorCommand* due = nullptr;
    for (std::uint64_t i = std::max(next_, port_->oldest()); i < port_->count(); ++i) {
      if (!is_due(port_->at(i), info)) break;
      due = &port_->at(i);
      next_ = i + 1;
    }
    return due;
  }

  void reset() {
    port_->clear();
    next_ = 0;
  }
  void state(StateArchive& archive) { archive(next_); }

 private:
  /// Stamps further ahead than this belong to another clock and count as none.
  static constexpr std::int64_t kForeignClockNs = 1'000'000'000;

  bool is_due(const ActuatorCommand& command, const StepInfo& info) const {
    const SimTime latest = delayed_ ? info.begin - info.dt : info.begin;
    return command.stamp.ns == 0 || command.stamp <= latest ||
           command.stamp.ns > info.end.ns + kForeignClockNs;
  }

  bool delayed_;
  std::uint64_t next_ = 0;
  InHandle<ActuatorCommand> port_;
};

}  // namespace trident::sim
