// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "trident_base/config_fields.h"
#include "trident_base/config_node.h"
#include "trident_base/registry.h"
#include "trident_nav/control/control_details.h"
#include "trident_nav/control/goal_arrival.h"
#include "trident_nav/control/motion.h"
#include "trident_nav/control/path_tracker.h"
#include "trident_nav/control/robot_state.h"
#include "trident_nav/core/footprint_checker.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// What a control law is made for.
struct ControlSetup {
  MotionLimits limits;
  Footprint footprint;
  double period_s = 0.05;  ///< Between commands.
  /// From what a command is computed of to when the base has it.
  double command_delay_s = 0.0;
  GoalTolerance tolerance;
  UnknownCells unknown = UnknownCells::kFree;
  std::uint64_t seed = 1;
  int threads = 1;

  bool can_turn_on_spot() const { return limits.min_turning_radius <= 0.0 && limits.wz_max > 0.0; }
  /// Throws Error naming field, value and range.
  void validate() const;
};

/// All that a law may look at for one command. What is referred to lives as long as the call.
struct Situation {
  const RobotState& state;
  const LocalPath& path;
  const Pose2& goal;
  const CostGrid& grid;
  const Tracks& tracks;
  const FootprintChecker& checker;
  const TwistWindow& window;  ///< What can be reached within a period.
  /// Points that the user wants to be passed near; nullptr: the law chooses its own.
  const std::vector<Point2>* via_points = nullptr;
  WatchedDetails watched = {};
  ControlDetails* details = nullptr;  ///< Gets what is watched; nullptr: nothing is.
};

/// What a law wants, or why it wants nothing.
struct Proposal {
  Twist2 twist;
  Failure failure = Failure::kNone;
  std::string reason;
};

/// A method to follow a path. The caller, a GuardedController, has checked its input, cuts the
/// path, judges the arrival, turns to the goal's heading, holds accelerations and guards against
/// contact.
class ControlLaw {
 public:
  ControlLaw() = default;
  ControlLaw(const ControlLaw&) = delete;
  ControlLaw& operator=(const ControlLaw&) = delete;
  virtual ~ControlLaw() = default;

  /// The limits of what it may send, for a robot with these: they are wider where a parameter of
  /// the law says that the robot can do more, as an escape backwards does.
  virtual MotionLimits limits(const MotionLimits& robot) const { return robot; }
  /// How much of the path ahead it wants to see [m].
  virtual double path_length_m() const = 0;
  virtual Proposal propose(const Situation& situation) = 0;
  /// Called after `propose` with what is really sent.
  virtual void on_sent(const Twist2& /*twist*/) {}
  /// Forgets everything: the next call belongs to another goal.
  virtual void reset() = 0;
};

/// Makes a law from its parameters, of which those absent have their defaults. Throws ConfigError.
using ControlLawFactory = DescribedFactory<std::unique_ptr<ControlLaw>(
    const ControlSetup& setup, const ConfigNode& params, const std::string& label)>;
using ControlLawRegistry = Registry<ControlLawFactory>;

/// All laws of this package under their short names and those that ROS users know.
ControlLawRegistry builtin_control_laws();

/// The name under which a controller is registered: `package::Class` and `package/Class` are the
/// same. A name that is not known is returned as it is.
std::string controller_name(const std::string& name);

}  // namespace trident::nav
