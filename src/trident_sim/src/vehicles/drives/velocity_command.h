// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/plugins/plugin_util.h"
#include "trident_sim/samples.h"

namespace trident::sim {

// Commands of vehicles, and what becomes of those that cannot be executed. Both kinds of problems
// are counted in World::diagnostics().

/// The newest velocity command that is a number. Others are refused and the last good one stays.
class VelocityInput {
 public:
  /// `timeout_s`: after which a command is over and the vehicle stands; negative: never.
  VelocityInput(const PluginContext& context, const std::string& topic, double timeout_s = -1.0);
  void poll(World& world);
  const TwistCommand& command() const { return command_; }
  /// Of the last command, whether a new one came in the last poll().
  bool is_new() const { return is_new_; }
  /// Whether the last command had timed out in the last poll().
  bool is_over() const { return is_over_; }
  void reset();
  void state(StateArchive& archive) { archive(command_, seen_, newest_, is_new_); }

 private:
  void refuse(World& world, const TwistCommand& command) const;

  std::string owner_;
  InHandle<TwistCommand> port_;
  double timeout_s_;
  TwistCommand command_;
  SimTime newest_;  ///< when it came
  std::uint64_t seen_ = 0;
  bool is_new_ = false;
  bool is_over_ = false;  ///< follows from the others at each poll()
};

/// A number in a command that may be at most +-limit.
class CommandLimit {
 public:
  struct Texts {
    std::string kind;      ///< of the diagnostic: "velocity command clamped"
    std::string unit;      ///< "m/s"
    std::string quantity;  ///< "speed of a wheel's rim"
    std::string what;      ///< is done: "it is scaled down to that limit, turn and all"
  };
  CommandLimit(std::string owner, Texts texts)
      : owner_(std::move(owner)), texts_(std::move(texts)) {}

  /// What to multiply `value` with so that it is within its limit. `is_new`: it comes from a
  /// command that has not been counted yet.
  double factor(World& world, double value, double limit, bool is_new) const;

 private:
  std::string owner_;
  Texts texts_;
};

/// Of the wheels of a vehicle, so that none is faster than its joint may be; that keeps the
/// curvature.
CommandLimit wheel_speed_limit(const std::string& owner);

}  // namespace trident::sim
