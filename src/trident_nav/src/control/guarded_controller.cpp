// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "config_split.h"
#include "escape.h"
#include "steering.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_nav/control/controller.h"
#include "trident_nav/core/footprint.h"

namespace trident::nav {
namespace {

// Of the path, what the robot may advance in a call: as far as this many of its radii.
constexpr double kAdvanceRadii = 4.0;

// Points of a path are no nearer to each other, however fine the costmap is: critics count points.
constexpr double kPathSpacing_m = 0.025;

std::string text(const char* format, double a, double b = 0.0, double c = 0.0) {
  char buffer[200];
  const int length = std::snprintf(buffer, sizeof buffer, format, a, b, c);
  return {buffer, static_cast<std::size_t>(std::max(length, 0))};
}

void require_positive(const char* field, double value) {
  if (!(value > 0.0)) {
    throw Error(std::string("limits: ") + field + " is " + text("%g", value) + " (> 0)");
  }
}

void require_legal(const MotionLimits& limits) {
  require_positive("vx_max", limits.vx_max);
  require_positive("ax_max", limits.ax_max);
  require_positive("decel_max", limits.decel_max);
  require_positive("alpha_max", limits.alpha_max);
  require_positive("wz_max", limits.wz_max);
  if (limits.vy_max > 0.0) require_positive("ay_max", limits.ay_max);
  if (!(limits.vy_max >= 0.0)) {
    throw Error("limits: vy_max is " + text("%g", limits.vy_max) + " (>= 0)");
  }
  if (!(limits.vx_min <= 0.0)) {
    throw Error("limits: vx_min is " + text("%g", limits.vx_min) + " (<= 0: how fast backwards)");
  }
  if (!(limits.min_turning_radius >= 0.0)) {
    throw Error("limits: min_turning_radius is " + text("%g", limits.min_turning_radius) +
                " (>= 0)");
  }
}

bool is_finite(const RobotState& state) {
  return is_finite(state.pose) && is_finite(state.twist) && std::isfinite(state.time_s);
}

std::string problem_of(const RobotState& state, const Path& path, const CostGrid& grid) {
  if (!is_finite(state)) return "The robot's state is not finite.";
  if (grid.cost == nullptr || grid.geometry.size() == 0) return "The costmap is empty.";
  const auto bad =
      std::find_if_not(path.begin(), path.end(), [](const Pose2& pose) { return is_finite(pose); });
  if (bad != path.end()) {
    return text("Pose %.0f of the path is not finite.", static_cast<double>(bad - path.begin()));
  }
  return path.empty() ? "The path has no poses." : "";
}

/// The trajectory of a base whose twist stays as it is.
ConsideredTrajectory held(const RobotState& state, const Twist2& twist) {
  constexpr double kDuration_s = 1.5, kStep_s = 0.1;
  ConsideredTrajectory trajectory;
  for (int i = 0; i * kStep_s <= kDuration_s; ++i) {
    const double after_s = i * kStep_s;
    trajectory.points.push_back({after_s, integrate(state.pose, twist, after_s), twist});
  }
  return trajectory;
}

ControlSetup granted(ControlSetup setup, const ControlLaw& law) {
  setup.validate();
  setup.limits = law.limits(setup.limits);
  setup.validate();
  return setup;
}

std::string describe(const ContactAhead& contact) {
  std::string where =
      text("at (%.2f, %.2f), %.2f s ahead.", contact.pose.x, contact.pose.y, contact.after_s);
  if (contact.track_id < 0) return "The braking trajectory touches an obstacle " + where;
  return "The braking trajectory touches moving obstacle " + std::to_string(contact.track_id) +
         " " + where;
}

}  // namespace

void ControlSetup::validate() const {
  require_legal(limits);
  if (!(command_delay_s >= 0.0) || !std::isfinite(command_delay_s)) {
    throw Error("control setup: command_delay_s is " + text("%g", command_delay_s) + " (>= 0)");
  }
  if (!(period_s > 0.0) || !std::isfinite(period_s)) {
    throw Error("control period: " + text("%g", period_s) + " s (> 0)");
  }
  if (!(footprint.circumscribed_radius > 0.0)) throw Error("footprint: it is missing");
}

GuardedController::GuardedController(const ControlSetup& setup, std::unique_ptr<ControlLaw> law,
                                     std::shared_ptr<const FootprintChecker> checker)
    : setup_(granted(setup, *law)),
      checker_(checker != nullptr
                   ? std::move(checker)
                   : std::make_shared<FootprintChecker>(setup.footprint, setup.unknown)),
      padded_checker_(grown_footprint(setup.footprint, guard_padding_m(setup.footprint)),
                      setup.unknown),
      law_(std::move(law)),
      guard_(setup_.limits, *checker_, padded_checker_, setup.period_s),
      arrival_(setup.tolerance, setup_.can_turn_on_spot()),
      tracker_(kAdvanceRadii * setup.footprint.circumscribed_radius),
      last_command_(setup_.limits, setup.period_s) {}

void GuardedController::reset() {
  law_->reset();
  arrival_.reset();
  tracker_.reset();
  last_command_.forget();
  blocked_calls_ = 0;
}

Proposal GuardedController::turn_to_goal(const RobotState& state, double goal_yaw,
                                         const CostGrid& grid) {
  const double near = wrap_angle(goal_yaw - state.pose.yaw);
  const auto rate = [&](double angle) {
    return Twist2{0.0, 0.0, turning_rate(setup_.limits, angle, setup_.period_s)};
  };
  const auto is_free = [&](double angle) {
    const int steps = 1 + static_cast<int>(std::fabs(angle) / 0.05);
    for (int i = 1; i <= steps; ++i) {
      const double yaw = wrap_angle(state.pose.yaw + angle * i / steps);
      if (!checker_->is_free(grid, {state.pose.x, state.pose.y, yaw})) return false;
    }
    return true;
  };
  if (is_free(near)) return {rate(near), Failure::kNone, ""};
  const double far = near - std::copysign(2.0 * kPi, near);
  if (is_free(far)) return {rate(far), Failure::kNone, ""};
  return {{}, Failure::kBlocked, "The turn to the goal's heading is blocked in both directions."};
}

Proposal GuardedController::propose(const RobotState& state, const Path& path, const CostGrid& grid,
                                    const Tracks& tracks, const TwistWindow& window) {
  const double spacing_m = std::max(grid.geometry.resolution, kPathSpacing_m);
  const LocalPath local = tracker_.update(path, state.pose, spacing_m, law_->path_length_m());
  // The law, too, leaves what the guard wants, unless the robot has less.
  const bool has_room = padded_checker_.is_free(grid, state.pose);
  const FootprintChecker& checker = has_room ? padded_checker_ : *checker_;
  Situation situation{state, local, path.back(), grid, tracks, checker, window};
  if (via_points_) situation.via_points = &*via_points_;
  if (watch_.wanted.trajectories || watch_.wanted.cells) {
    situation.watched = watch_.wanted;
    situation.details = &watch_.noted;
    watch_.noted.time_s = state.time_s;
  }
  return law_->propose(situation);
}

/// What the law proposes, as fast as the robot can; a failure where that is not to be sent.
CommandOutcome GuardedController::judged(const RobotState& state, Proposal proposal,
                                         const TwistWindow& window, const CostGrid& grid,
                                         const Tracks& tracks) const {
  CommandOutcome outcome;
  outcome.failure = proposal.failure;
  outcome.reason = std::move(proposal.reason);
  if (outcome.failure != Failure::kNone) return outcome;
  if (!is_finite(proposal.twist)) {
    outcome.failure = Failure::kInvalidInput;
    outcome.reason = "The control law's command is not finite.";
    return outcome;
  }
  outcome.twist = admissible_twist(setup_.limits, window, proposal.twist);
  if (const auto contact = guard_.first_contact(state, outcome.twist, grid, tracks)) {
    outcome.failure = Failure::kBlocked;
    outcome.reason = describe(*contact);
  }
  return outcome;
}

CommandOutcome GuardedController::guarded(const RobotState& state, Proposal proposal,
                                          const TwistWindow& window, const CostGrid& grid,
                                          const Tracks& tracks) {
  CommandOutcome outcome = judged(state, std::move(proposal), window, grid, tracks);
  if (outcome.failure == Failure::kNone) {
    blocked_calls_ = 0;
    return outcome;
  }
  // A robot that is held in a tight place first makes room, so that the law has other commands.
  constexpr int kPatience = 4;
  if (outcome.failure == Failure::kBlocked && ++blocked_calls_ > kPatience) {
    if (const auto escape = escape_twist(setup_, guard_, state, grid, tracks)) {
      outcome.twist = *escape;
      outcome.failure = Failure::kNone;
      return outcome;
    }
  }
  outcome.twist = braked(setup_.limits, state.twist, setup_.period_s);
  return outcome;
}

CommandOutcome GuardedController::command(const RobotState& measured, const Path& path,
                                          const CostGrid& grid, const Tracks& tracks) {
  watch_.noted = {};
  RobotState state = measured;
  // What odometry says of a motion that the base does not have is noise.
  if (setup_.limits.vy_max <= 0.0 && std::isfinite(state.twist.vy)) state.twist.vy = 0.0;
  CommandOutcome outcome;
  outcome.reason = problem_of(state, path, grid);
  if (outcome.reason.empty()) {
    outcome = commanded(state, path, grid, tracks);
  } else {
    outcome.failure = path.empty() ? Failure::kInvalidPath : Failure::kInvalidInput;
    if (is_finite(state.twist)) {
      outcome.twist = braked(setup_.limits, last_command_.motion(state), setup_.period_s);
    }
  }
  last_command_.note(outcome.twist, state.time_s);
  return outcome;
}

/// `measured` is legal, and so are path and grid.
CommandOutcome GuardedController::commanded(const RobotState& measured, const Path& path,
                                            const CostGrid& grid, const Tracks& tracks) {
  RobotState state = measured;
  state.twist = last_command_.motion(measured);
  const ArrivalPhase phase = arrival_.update(measured, path.back());
  if (phase == ArrivalPhase::kReached) {
    CommandOutcome outcome;
    outcome.twist = braked(setup_.limits, state.twist, setup_.period_s);
    outcome.goal_reached = true;
    return outcome;
  }
  // Until a command acts, the base continues as it moves.
  state.pose = integrate(state.pose, state.twist, setup_.command_delay_s);
  const TwistWindow window = reachable_window(setup_.limits, state.twist, setup_.period_s);
  const bool turns = phase == ArrivalPhase::kTurn;
  Proposal proposal = turns ? turn_to_goal(state, path.back().yaw, grid)
                            : propose(state, path, grid, tracks, window);
  CommandOutcome outcome = guarded(state, std::move(proposal), window, grid, tracks);
  if (!turns) law_->on_sent(outcome.twist);
  if (watch_.wanted.trajectories && !watch_.noted.selected) {
    // Not all laws weigh trajectories.
    watch_.noted.time_s = state.time_s;
    watch_.noted.selected = watch_.noted.trajectories.size();
    watch_.noted.trajectories.push_back(held(state, outcome.twist));
  }
  return outcome;
}

std::unique_ptr<Controller> make_controller(const std::string& law, const ControlSetup& setup,
                                            const ConfigNode& params, const std::string& label,
                                            std::shared_ptr<const FootprintChecker> checker) {
  setup.validate();
  const ControlLawRegistry registry = builtin_control_laws();
  const ConfigNode given = expand_dotted_keys(params, label);
  return std::make_unique<GuardedController>(
      setup, registry.get(controller_name(law))(setup, given, label), std::move(checker));
}

}  // namespace trident::nav
