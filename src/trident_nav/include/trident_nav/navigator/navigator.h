// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trident_nav/control/controller.h"
#include "trident_nav/control/last_command.h"
#include "trident_nav/navigator/navigator_params.h"
#include "trident_nav/navigator/navigator_world.h"
#include "trident_nav/navigator/path_keeper.h"
#include "trident_nav/navigator/recovery.h"

namespace trident::nav {

/// What a navigator gets for one period.
struct NavigatorInput {
  double now_s = 0.0;
  Pose2 robot_global;  ///< In the frame of goals and paths.
  RobotState state;    ///< In the local costmap's frame, of the same time as `robot_global`.
  CostGrid local;      ///< The newest local costmap.
  Tracks tracks;
};

enum class NavigatorStatus { kIdle, kActive, kSucceeded, kAborted };

/// A recovery that has begun.
struct RecoveryNote {
  std::string name;
  std::size_t index = 0;  ///< From 0.
  std::size_t count = 0;
  std::string cause;  ///< Why.
};

/// What a navigator wants for one period.
struct NavigatorOutput {
  NavigatorStatus status = NavigatorStatus::kIdle;
  /// To be sent, but not while idle: others may drive then.
  Twist2 twist;
  std::string text;     ///< Of an outcome: upstream's sentence, then the cause.
  std::string waiting;  ///< Why the robot stands although it has a goal; empty: it does not.
  bool has_new_path = false;
  std::optional<RecoveryNote> recovery;
};

/// What a navigator drives with.
struct NavigatorParts {
  NavigatorParams params;
  MotionLimits limits;
  Footprint footprint;
  std::vector<NamedRecovery> recoveries;
};

/// move_base's procedure for a goal: plan, follow, and where that fails for too long, one recovery
/// after the other, then the next plan. One call of step() per controller period, on any clock that
/// does not go back; the world plans when it likes. Stale sources stop the robot, which continues
/// by itself when they are back, and no patience runs out meanwhile. Not thread-safe.
class Navigator {
 public:
  /// `world` and `controller` outlive the navigator.
  Navigator(NavigatorParts parts, NavigatorWorld& world, Controller& controller);

  const NavigatorParams& params() const { return parts_.params; }
  bool is_recovering() const { return phase_ == Phase::kRecovering; }
  /// Drives with other parameters, limits and recoveries from the next step on, toward the same
  /// goal; not while it is recovering.
  void set_parts(NavigatorParts parts);

  /// Takes a goal in the global costmap's frame in place of any other.
  void set_goal(const Pose2& goal, double now_s);
  /// Forgets the goal; the robot is not commanded any more.
  void cancel();
  bool is_active() const { return phase_ != Phase::kIdle; }
  const Pose2& goal() const { return goal_; }
  /// The path that is followed, in the global costmap's frame; empty: none.
  const Path& path() const { return keeper_.path(); }

  /// One period. A state that is older than `now_s` is taken to where the robot is by then.
  NavigatorOutput step(const NavigatorInput& given);

 private:
  enum class Phase { kIdle, kPlanning, kControlling, kRecovering };
  enum class Trigger { kPlanning, kControlling, kOscillation };

  void forget_progress(double now_s);
  bool extend_trail(const Pose2& pose);
  void note_motion(const NavigatorInput& input);
  void note_path_progress(const NavigatorInput& input);
  void note_progress(const NavigatorInput& input);
  void reroute_if_stuck(const NavigatorInput& input);
  void begin_advance(double left_m, double now_s);
  double stuck_time_s() const;
  bool waits_for_sources(const NavigatorInput& input, NavigatorOutput* output);
  void plan(const NavigatorInput& input, NavigatorOutput* output);
  void take_plan(const NavigatorInput& input, NavigatorOutput* output);
  void offer_path(const NavigatorInput& input, Path path, NavigatorOutput* output);
  std::string used_up_text(double failing_s) const;
  void refuse_plan(const NavigatorInput& input, const PlanOutcome& outcome,
                   NavigatorOutput* output);
  void control(const NavigatorInput& input, NavigatorOutput* output);
  void miss_command(const NavigatorInput& input, const CommandOutcome& outcome,
                    NavigatorOutput* output);
  void recover(const NavigatorInput& input, NavigatorOutput* output);
  std::size_t untried_recovery(const Pose2& robot);
  void begin_recovery(Trigger trigger, const NavigatorInput& input, NavigatorOutput* output);
  void slow_down(const NavigatorInput& input, NavigatorOutput* output);
  void finish(NavigatorStatus status, std::string text, NavigatorOutput* output);
  Path local_path(const NavigatorInput& input) const;
  Twist2 braking(const NavigatorInput& input) const;

  NavigatorParts parts_;
  NavigatorWorld& world_;
  Controller& controller_;
  PathKeeper keeper_;
  Phase phase_ = Phase::kIdle;
  Pose2 goal_;
  Path trail_;
  /// Times and counts since which something is tried.
  struct Patience {
    double plan_s = 0.0, command_s = 0.0, motion_s = 0.0, request_s = 0.0, step_s = 0.0;
    double progress_s = 0.0, advance_s = 0.0, failing_s = 0.0;
    Pose2 progress_from;
    Pose2 motion_from;
    std::optional<double> least_left_m;  ///< Of the path, at `advance_s`.
    std::optional<double> path_left_m;   ///< Length of the path left at `motion_from`.
    int failed_plans = 0;
    bool has_request = false;

    void begin_motion(const Pose2& from, double now_s);
  };
  Patience since_;
  Trigger trigger_ = Trigger::kPlanning;
  std::size_t next_recovery_ = 0;
  /// Where recoveries began since this goal came, and how many were tried there.
  struct TriedPlace {
    Point2 at;
    std::size_t count = 0;
  };
  std::vector<TriedPlace> tried_;
  /// A slow drive, if there is one, and where it began.
  struct Slow {
    std::optional<SlowDrive> drive;
    Pose2 from;
  };
  Slow slow_;
  LastCommand last_command_;
  std::string cause_;
  /// Why the next path replaces the present one, better or not.
  struct Replaced {
    bool is_blocked = false;   ///< It touches something.
    bool is_rerouted = false;  ///< The robot is stuck on it.
  };
  Replaced replaced_;
};

}  // namespace trident::nav
