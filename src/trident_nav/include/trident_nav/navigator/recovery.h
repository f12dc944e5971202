// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Recoveries: what a navigator tries before it gives a goal up. A new one is a source that
/// registers it and a line in navigator.cmake.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "trident_base/registry.h"
#include "trident_base/yaml_config.h"
#include "trident_nav/control/controller.h"
#include "trident_nav/core/footprint_checker.h"
#include "trident_nav/navigator/navigator_world.h"

namespace trident::nav {

/// What a recovery may look at and use in one step. What is referred to lives as long as the call.
struct RecoverySituation {
  double now_s;
  const RobotState& state;  ///< In the local costmap's frame.
  const CostGrid& local;
  const Tracks& tracks;
  const Path& trail;  ///< Where the robot came along, oldest first, in the local costmap's frame.
  NavigatorWorld& world;
  Controller& controller;
};

/// Limits of commands until the robot is some distance off.
struct SlowDrive {
  double trans_max = 0.0;   ///< [m/s]
  double rot_max = 0.0;     ///< [rad/s]
  double distance_m = 0.0;  ///< From where they begin.

  /// The command within them, of the same curvature.
  Twist2 limited(const Twist2& twist) const;
};

/// What a step of a recovery gives.
struct RecoveryStep {
  Twist2 twist;
  bool is_done = false;
  std::string note;  ///< When done: what was achieved, or why nothing was.
  /// When done: how the robot drives at first.
  std::optional<SlowDrive> slow = std::nullopt;
};

class Recovery {
 public:
  Recovery() = default;
  Recovery(const Recovery&) = delete;
  Recovery& operator=(const Recovery&) = delete;
  virtual ~Recovery() = default;

  /// Before the first step of each run.
  virtual void start() {}
  virtual RecoveryStep step(const RecoverySituation& situation) = 0;
};

/// What a recovery is made for.
struct RecoverySetup {
  MotionLimits limits;
  Footprint footprint;
  double period_s = 0.05;  ///< Between steps.
};

/// Makes a recovery from its parameters, a map; `source` names where they come from in errors.
/// Throws ConfigError.
using RecoveryFactory = std::function<std::unique_ptr<Recovery>(
    const RecoverySetup& setup, const ConfigNode& parameters, const std::string& source)>;
using RecoveryRegistry = Registry<RecoveryFactory>;

/// The recoveries of this package, under upstream's names in the form `package/Class` where they
/// have one.
RecoveryRegistry builtin_recoveries();

/// A recovery and how users call it.
struct NamedRecovery {
  std::string name;
  std::unique_ptr<Recovery> recovery;
};

}  // namespace trident::nav
