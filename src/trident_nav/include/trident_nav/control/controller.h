// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trident_nav/control/braking_guard.h"
#include "trident_nav/control/control_details.h"
#include "trident_nav/control/control_law.h"
#include "trident_nav/control/goal_arrival.h"
#include "trident_nav/control/last_command.h"
#include "trident_nav/control/path_tracker.h"
#include "trident_nav/control/robot_state.h"
#include "trident_nav/core/outcome.h"

namespace trident::nav {

/// Drives a robot along paths, one call per period. Not thread-safe.
class Controller {
 public:
  Controller() = default;
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;
  virtual ~Controller() = default;

  /// The next command. `path` may be another one in each call; its last pose is the goal. State,
  /// path and tracks are in the grid's frame; the grid is the newest one.
  virtual CommandOutcome command(const RobotState& state, const Path& path, const CostGrid& grid,
                                 const Tracks& tracks) = 0;
  /// Forgets everything: the next call belongs to another goal.
  virtual void reset() = 0;

  /// What the next commands note for details(); at first nothing.
  virtual void set_watched(const WatchedDetails& /*watched*/) {}
  /// What was noted for the last command; changes no command.
  virtual ControlDetails details() const { return {}; }
  /// Points in the grid's frame that trajectories shall pass near, in place of those that a law
  /// takes from the path; nothing: its own. Laws without such points ignore them.
  virtual void set_via_points(const std::optional<std::vector<Point2>>& /*points*/) {}
};

/// A control law within what all laws share: checked input, pruned path, arrival, turn to the
/// goal's heading, acceleration limits and the guard.
class GuardedController final : public Controller {
 public:
  /// `checker` nullptr: a FootprintChecker of the setup. Throws Error.
  GuardedController(const ControlSetup& setup, std::unique_ptr<ControlLaw> law,
                    std::shared_ptr<const FootprintChecker> checker = nullptr);

  CommandOutcome command(const RobotState& state, const Path& path, const CostGrid& grid,
                         const Tracks& tracks) override;
  void reset() override;
  void set_watched(const WatchedDetails& watched) override { watch_.wanted = watched; }
  ControlDetails details() const override { return watch_.noted; }
  void set_via_points(const std::optional<std::vector<Point2>>& points) override {
    via_points_ = points;
  }

 private:
  CommandOutcome commanded(const RobotState& state, const Path& path, const CostGrid& grid,
                           const Tracks& tracks);
  Proposal propose(const RobotState& state, const Path& path, const CostGrid& grid,
                   const Tracks& tracks, const TwistWindow& window);
  Proposal turn_to_goal(const RobotState& state, double goal_yaw, const CostGrid& grid);
  CommandOutcome judged(const RobotState& state, Proposal proposal, const TwistWindow& window,
                        const CostGrid& grid, const Tracks& tracks) const;
  CommandOutcome guarded(const RobotState& state, Proposal proposal, const TwistWindow& window,
                         const CostGrid& grid, const Tracks& tracks);

  ControlSetup setup_;
  std::shared_ptr<const FootprintChecker> checker_;
  FootprintChecker padded_checker_;
  std::unique_ptr<ControlLaw> law_;
  BrakingGuard guard_;
  GoalArrival arrival_;
  PathTracker tracker_;
  LastCommand last_command_;
  int blocked_calls_ = 0;  ///< In a row.
  std::optional<std::vector<Point2>> via_points_;
  struct Watch {
    WatchedDetails wanted;
    ControlDetails noted;
  };
  Watch watch_;
};

/// A guarded controller with the law of that name in `builtin_control_laws()`. `label` names the
/// source of the parameters in errors. Throws Error for an unknown name, a bad setup or parameter.
std::unique_ptr<Controller> make_controller(
    const std::string& law, const ControlSetup& setup, const ConfigNode& params = {},
    const std::string& label = "parameters",
    std::shared_ptr<const FootprintChecker> checker = nullptr);

}  // namespace trident::nav
