// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/plugins/plugin_util.h"
#include "trident_sim/commands.h"

namespace trident::sim {

/// Numbers that command an actuator, on a topic. One that is not finite is refused, one beyond the
/// limits is cut to them; both are counted among the world's diagnostics.
class ActuatorInput {
 public:
  /// kTopic: on a topic of numbers. kSingleTopic: of numbers of single precision, as VRX'.
  /// kStampedTopic: of uuv_simulator's. kCaller: not on a topic of its own;
  /// `topic` is then where its caller has the numbers from.
  enum class Source { kTopic, kSingleTopic, kStampedTopic, kCaller };

  /// `what` is what diagnostics call it, `unit` is printed with the numbers.
  ActuatorInput(const PluginContext& context, const std::string& topic, std::string what,
                std::string unit, const Limits& limits, Source source);

  /// The newest legal number since the last call; none: nothing came.
  std::optional<double> take(World& world);
  /// A number within the limits; none: it is not finite.
  std::optional<double> check(World& world, double value) const;
  void reset();
  void state(StateArchive& archive) { archive(seen_); }

 private:
  template <class Port>
  std::optional<double> newest_of(World& world, const Port& port);
  void diagnose(World& world, Severity severity, double value) const;

  std::string owner_, topic_, what_, unit_;
  Limits limits_;
  InHandle<ScalarSample> port_;
  InHandle<SingleNumber> single_;
  InHandle<StampedNumber> stamped_;
  std::uint64_t seen_ = 0;
};

}  // namespace trident::sim
