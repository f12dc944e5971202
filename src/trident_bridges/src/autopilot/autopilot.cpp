// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/autopilot.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "autopilot/texts.h"
#include "trident_base/string_util.h"

namespace trident::bridges {
namespace {

constexpr double kTightRadius_m = 0.3;  // of places that are flown to on lines
constexpr double kNearHome_m = 1.0;     // a return from there does not climb

}  // namespace

Autopilot::Autopilot(const AutopilotOptions& options)
    : options_(options),
      parameters_(options.flavor, options.vehicle, options.system_id),
      limits_(limits_of(parameters_, options.flavor, options.vehicle)),
      mode_(modes_of(options.flavor, options.vehicle).front().mode),
      mode_to_arm_in_(mode_) {
  flight_.set_limits(limits_);
  drive_.set_limits(limits_);
}

bool Autopilot::is_landed() const { return flies() ? flight_.is_landed() : true; }

std::uint32_t Autopilot::custom_mode() const {
  const ModeEntry* const entry = find_mode(options_.flavor, options_.vehicle, mode_);
  return entry == nullptr ? 0 : entry->custom_mode;
}

void Autopilot::report(int severity, std::string text) {
  AutopilotEvent event;
  event.severity = severity;
  event.text = std::move(text);
  events_.push_back(std::move(event));
}

std::vector<AutopilotEvent> Autopilot::take_events() { return std::exchange(events_, {}); }

Answer Autopilot::set_parameter(std::string_view name, double value) {
  Answer answer = parameters_.set(name, value);
  if (!answer.is_good()) return answer;
  limits_ = limits_of(parameters_, options_.flavor, options_.vehicle);
  fence_.radius_m = limits_.fence_radius_m;
  fence_.height_m = limits_.fence_height_m;
  flight_.set_limits(limits_);
  drive_.set_limits(limits_);
  return answer;
}

Answer Autopilot::load_mission(std::vector<MissionItem> items) {
  Answer answer = check_mission(items, options_.vehicle);
  if (!answer.is_good()) return answer;
  mission_.load(std::move(items));
  return answer;
}

Answer Autopilot::load_fence(std::vector<Fence::Region> regions) {
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const std::string problem = problem_of(regions[i]);
    if (!problem.empty()) return denied("fence region " + std::to_string(i) + ": " + problem);
  }
  fence_.regions = std::move(regions);
  return {};
}

void Autopilot::set_home(const Eigen::Vector3d& p_world_m) {
  home_ = p_world_m;
  fence_.home_m = p_world_m;
  AutopilotEvent event;
  event.kind = AutopilotEvent::Kind::kHomeChanged;
  events_.push_back(event);
}

Setpoint Autopilot::step(SimTime now, const VehicleState& state) {
  state_ = state;
  if (!home_ && state.position_stamp) set_home(state.p_world_m);
  const WatchedVehicle watched{mode_, is_armed_, is_landed(), options_.vehicle, state_};
  if (const auto action = watch_.check(now, watched, limits_, fence_)) act(*action, now);
  if (!is_armed_) {
    drive_.rest();
    return setpoint_ = Setpoint();
  }
  guide(now);
  return setpoint_;
}

/// An armed vehicle's step.
void Autopilot::guide(SimTime now) {
  advance(now);
  drive_.expire(state_, now);
  if (!flies()) {
    setpoint_ = drive_.setpoint();
    return;
  }
  setpoint_ = flight_.step(now, state_);
  end_landing(now);
}

/// One that lands or returns already is left alone, and never kept from landing.
bool Autopilot::is_left_alone(Mode wanted) const {
  const bool is_ending = mode_ == Mode::kLand || (mode_ == Mode::kReturn && wanted != Mode::kLand);
  return is_ending && wanted != Mode::kPosition && wanted != Mode::kManual;
}

void Autopilot::act(const FailsafeAction& action, SimTime now) {
  if (!action.mode || is_left_alone(*action.mode)) {
    report(kSeverityWarning, "Failsafe: " + action.text + ".");
    return;
  }
  const ModeEntry* const entry = find_mode(options_.flavor, options_.vehicle, *action.mode);
  const Mode mode = entry != nullptr ? *action.mode : Mode::kHold;
  const ModeEntry* const shown = find_mode(options_.flavor, options_.vehicle, mode);
  report(kSeverityWarning,
         "Failsafe: " + action.text + "; mode " + (shown != nullptr ? shown->name : "BRAKE") + ".");
  enter(mode, now);
}

void Autopilot::enter(Mode mode, SimTime now) {
  if (mode == Mode::kHold && find_mode(options_.flavor, options_.vehicle, mode) == nullptr) {
    mode = Mode::kBrake;
  }
  mode_ = mode;
  if (!prevents_arming(mode) && mode != Mode::kOffboard) mode_to_arm_in_ = mode;
  if (is_armed_) begin(mode, now);
}

/// What a mode does first.
void Autopilot::begin(Mode mode, SimTime now) {
  switch (mode) {
    case Mode::kReturn:
      begin_return(now);
      break;
    case Mode::kLand:
      flight_.land(now);
      break;
    case Mode::kMission:
      mission_.resume();
      break;
    case Mode::kTakeOff:
      go_to(state_.p_world_m + Eigen::Vector3d(0.0, 0.0, limits_.take_off_height_m), now);
      break;
    default:
      stop(now);
      break;
  }
}

void Autopilot::go_to(const Eigen::Vector3d& p_world_m, SimTime now) {
  if (flies()) {
    flight_.go_to(p_world_m, now);
  } else {
    drive_.go_to(p_world_m, state_);
  }
}

void Autopilot::stop(SimTime now) {
  if (flies()) {
    flight_.brake(now);
  } else {
    drive_.stop(state_);
  }
}

bool Autopilot::has_arrived(SimTime now) const {
  if (!flies()) return drive_.has_arrived(state_, limits_.acceptance_radius_m);
  return flight_.has_arrived(now, state_, std::min(limits_.acceptance_radius_m, kTightRadius_m));
}

void Autopilot::advance(SimTime now) {
  if (is_manual(mode_)) return advance_by_sticks(now);
  if (mode_ == Mode::kMission) return advance_mission(now);
  if (mode_ == Mode::kReturn) return advance_return(now);
  if (mode_ == Mode::kTakeOff && has_arrived(now)) {
    report(kSeverityInfo, "Take-off is done.");
    enter(Mode::kHold, now);
  }
}

void Autopilot::advance_by_sticks(SimTime now) {
  const auto sticks = watch_.sticks(now);
  if (!flies()) {
    if (sticks) {
      drive_.take_sticks(*sticks);
    } else {
      drive_.rest();
    }
    return;
  }
  if (sticks) {
    flight_.take_sticks(*sticks, mode_, now);
    sticks_lead_ = true;
  } else if (sticks_lead_) {
    sticks_lead_ = false;
    flight_.brake(now);
  }
}

void Autopilot::advance_mission(SimTime now) {
  MissionReport report;
  const MissionOrder order = mission_.step(now, has_arrived(now), report);
  apply(report, now);
  if (order.is_new) carry_out(order, now);
}

void Autopilot::apply(const MissionReport& report, SimTime now) {
  if (report.reached >= 0) {
    AutopilotEvent event;
    event.kind = AutopilotEvent::Kind::kMissionReached;
    event.index = report.reached;
    events_.push_back(event);
  }
  if (report.speed_m_s > 0.0) handle(SpeedRequest{report.speed_m_s}, now);
  if (report.sets_yaw) handle(YawRequest{report.yaw, report.is_yaw_relative}, now);
  if (report.looks_at) handle(LookAtRequest{report.look_at_m}, now);
  if (report.sets_home) set_home(state_.p_world_m);
  if (report.fence >= 0) limits_.fence_is_on = report.fence == 1;
}

void Autopilot::carry_out(const MissionOrder& order, SimTime now) {
  using Kind = MissionOrder::Kind;
  switch (order.kind) {
    case Kind::kGoTo:
      if (flies()) flight_.look_along(order.p_m, now);
      return go_to(order.p_m, now);
    case Kind::kTakeOff:
      return go_to({state_.p_world_m.x(), state_.p_world_m.y(), order.p_m.z()}, now);
    case Kind::kCircle:
      return flight_.circle(order.p_m, order.radius_m, order.turns, now);
    case Kind::kStay:
      return stop(now);
    case Kind::kLand:
      return enter(Mode::kLand, now);
    case Kind::kReturn:
      return enter(Mode::kReturn, now);
    case Kind::kFinished:
      report(kSeverityInfo, "Mission is finished.");
      return stop(now);
  }
}

void Autopilot::begin_return(SimTime now) {
  const Eigen::Vector3d home = home_.value_or(state_.p_world_m);
  const bool is_near = (home - state_.p_world_m).head<2>().norm() < kNearHome_m;
  return_.stage = is_near ? ReturnProgress::Stage::kCross : ReturnProgress::Stage::kClimb;
  if (!flies() || is_near) {
    return_.stage = ReturnProgress::Stage::kCross;
    return go_to(flies() ? Eigen::Vector3d(home.x(), home.y(), state_.p_world_m.z()) : home, now);
  }
  const double height = std::max(state_.p_world_m.z(), home.z() + limits_.return_height_m);
  flight_.look_along(home, now);
  go_to({state_.p_world_m.x(), state_.p_world_m.y(), height}, now);
}

void Autopilot::advance_return(SimTime now) {
  using Stage = ReturnProgress::Stage;
  if (!has_arrived(now)) return;
  const Eigen::Vector3d home = home_.value_or(state_.p_world_m);
  switch (return_.stage) {
    case Stage::kClimb:
      return_.stage = Stage::kCross;
      return go_to({home.x(), home.y(), state_.p_world_m.z()}, now);
    case Stage::kCross:
      return_ = {Stage::kWait, now};
      if (!flies()) drive_.stop(state_);
      return;
    case Stage::kWait:
      if (!flies() || (now - return_.waits_since).seconds() < limits_.return_loiter_s) return;
      return_.stage = Stage::kLand;
      return flight_.land(now);
    case Stage::kLand:
      return;
  }
}

void Autopilot::end_landing(SimTime now) {
  const bool lands = mode_ == Mode::kLand || mode_ == Mode::kReturn;
  if (!lands || !flight_.is_landed() || limits_.disarm_after_landing_s <= 0.0) return;
  if (flight_.landed_s(now) >= limits_.disarm_after_landing_s) disarm("landed");
}

void Autopilot::disarm(const std::string& reason) {
  is_armed_ = false;
  setpoint_ = Setpoint();
  // PX4 goes back to a mode for the next flight, ArduPilot leaves that to its pilot.
  if (options_.flavor == Flavor::kPx4 && prevents_arming(mode_)) mode_ = mode_to_arm_in_;
  report(kSeverityInfo, "Disarmed: " + reason + ".");
}

}  // namespace trident::bridges
