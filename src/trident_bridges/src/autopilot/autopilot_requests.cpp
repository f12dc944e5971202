// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "autopilot/texts.h"
#include "trident_base/angle.h"
#include "trident_base/string_util.h"
#include "trident_bridges/autopilot/autopilot.h"

namespace trident::bridges {
namespace {

constexpr double kGreatestHeight_m = 1000.0;

template <typename Vector>
bool is_finite(const std::optional<Vector>& vector) {
  return !vector || vector->allFinite();
}

bool is_finite(const std::optional<double>& number) { return std::isfinite(number.value_or(0.0)); }

template <typename... Parts>
bool are_finite(const Parts&... parts) {
  return (is_finite(parts) && ...);
}

}  // namespace

/// Why a mode cannot be entered.
std::optional<std::string> Autopilot::mode_problem(Mode mode, SimTime now) const {
  if (needs_position(mode) && !state_.position_stamp) return "position: none has come";
  if (mode == Mode::kOffboard) return watch_.offboard_problem(now);
  if (mode == Mode::kMission && mission_.size() == 0) return "mission: it has 0 items, 1 is needed";
  if (mode == Mode::kReturn && !home_) return "home: it is not known";
  return std::nullopt;
}

bool Autopilot::is_offboard_near(std::uint32_t custom_mode, SimTime now) const {
  const ModeEntry* const entry = find_mode(options_.flavor, options_.vehicle, custom_mode);
  return entry != nullptr && entry->mode == Mode::kOffboard && state_.position_stamp &&
         watch_.is_offboard_near(now);
}

Answer Autopilot::enter_requested(const ModeEntry& entry, SimTime now) {
  if (const auto problem = mode_problem(entry.mode, now)) {
    const std::string text = std::string("Mode ") + entry.name + " denied: " + *problem;
    report(kSeverityError, text);
    return refused(text);
  }
  const bool is_new = entry.mode != mode_;
  if (is_new) {
    report(kSeverityInfo, std::string("Mode ") + entry.name + ".");
    enter(entry.mode, now);
  }
  return {};
}

/// One function for each request.
struct Autopilot::Handler {
  Autopilot& pilot;
  SimTime now;

  Answer operator()(const ArmRequest& request) const { return pilot.arm(request, now); }
  Answer operator()(const ModeRequest& request) const;
  Answer operator()(const TakeOffRequest& request) const;
  Answer operator()(const GoToRequest& request) const;
  Answer operator()(const ReturnRequest&) const { return change_to(Mode::kReturn); }
  Answer operator()(const LandRequest&) const { return change_to(Mode::kLand); }
  Answer operator()(const SpeedRequest& request) const;
  Answer operator()(const YawRequest& request) const;
  Answer operator()(const LookAtRequest& request) const;
  Answer operator()(const MissionStartRequest& request) const;
  Answer operator()(const MissionItemRequest& request) const;
  Answer operator()(const PauseRequest& request) const;
  Answer operator()(const FenceRequest& request) const;
  Answer operator()(const HomeRequest& request) const;
  Answer operator()(const CheckRequest&) const;

  Answer change_to(Mode mode) const;
  Answer need_armed(const char* what) const;
  Answer check_take_off(double height_m) const;
  void depart(const GoToRequest& request) const;
};

Answer Autopilot::Handler::change_to(Mode mode) const {
  const ModeEntry* const entry = find_mode(pilot.options_.flavor, pilot.options_.vehicle, mode);
  if (entry == nullptr) return {Result::kUnsupported, "this vehicle has no such mode"};
  return pilot.enter_requested(*entry, now);
}

Answer Autopilot::Handler::need_armed(const char* what) const {
  if (pilot.is_armed_) return {};
  const std::string text = std::string(what) + " denied: the vehicle is disarmed, it must be armed";
  pilot.report(kSeverityError, text);
  return refused(text);
}

Answer Autopilot::Handler::operator()(const ModeRequest& request) const {
  const auto& options = pilot.options_;
  const ModeEntry* const entry = find_mode(options.flavor, options.vehicle, request.custom_mode);
  if (entry != nullptr) return pilot.enter_requested(*entry, now);
  const std::string text =
      "Mode " + std::to_string(request.custom_mode) +
      " is not known, legal: " + join(mode_names(options.flavor, options.vehicle));
  pilot.report(kSeverityError, text);
  return denied(text);
}

Answer Autopilot::Handler::check_take_off(double height_m) const {
  if (!pilot.flies()) return {Result::kUnsupported, "take-off: this vehicle does not fly"};
  if (!(height_m > 0.0 && height_m <= kGreatestHeight_m)) {
    return denied("take-off: height " + number_text(height_m) + " m, legal: above 0, up to " +
                  number_text(kGreatestHeight_m) + " m");
  }
  if (pilot.options_.flavor != Flavor::kPx4 && pilot.mode_ != Mode::kGuided) {
    return refused("take-off: the mode must be GUIDED");
  }
  return need_armed("Take-off");
}

Answer Autopilot::Handler::operator()(const TakeOffRequest& request) const {
  const double height_m =
      std::isnan(request.height_m) ? pilot.limits_.take_off_height_m : request.height_m;
  if (Answer answer = check_take_off(height_m); !answer.is_good()) return answer;
  const Eigen::Vector3d goal = pilot.state_.p_world_m + Eigen::Vector3d(0.0, 0.0, height_m);
  if (const auto breach = pilot.fence_problem(goal)) return refused("take-off: " + *breach);
  if (pilot.options_.flavor == Flavor::kPx4) pilot.mode_ = Mode::kTakeOff;
  pilot.flight_.go_to(goal, now);
  return {};
}

Answer Autopilot::Handler::operator()(const GoToRequest& request) const {
  if (!request.p_world_m.allFinite()) return denied("go to: the place is not finite");
  if (Answer answer = need_armed("Go to"); !answer.is_good()) return answer;
  if (const auto breach = pilot.fence_problem(request.p_world_m)) {
    return refused("go to: " + *breach);
  }
  const bool is_px4 = pilot.options_.flavor == Flavor::kPx4;
  Answer answer = change_to(is_px4 ? Mode::kHold : Mode::kGuided);
  if (answer.is_good()) depart(request);
  return answer;
}

/// Leaves for the place, with the speed and the heading that are asked for.
void Autopilot::Handler::depart(const GoToRequest& request) const {
  if (request.speed_m_s > 0.0) (*this)(SpeedRequest{request.speed_m_s});
  if (pilot.flies()) pilot.flight_.look_along(request.p_world_m, now);
  if (request.yaw) pilot.flight_.turn_to(*request.yaw);
  pilot.go_to(request.p_world_m, now);
}

Answer Autopilot::Handler::operator()(const SpeedRequest& request) const {
  if (!(request.speed_m_s > 0.0 && request.speed_m_s <= 100.0)) {
    return denied("speed: " + number_text(request.speed_m_s) + " m/s, legal: above 0, up to 100");
  }
  pilot.limits_.speed_m_s = request.speed_m_s;
  pilot.flight_.set_limits(pilot.limits_);
  pilot.drive_.set_limits(pilot.limits_);
  return {};
}

Answer Autopilot::Handler::operator()(const YawRequest& request) const {
  if (!pilot.flies()) return {Result::kUnsupported, "yaw: this vehicle turns as it goes"};
  if (!std::isfinite(request.yaw)) return denied("yaw: the angle is not finite");
  const double base = request.is_relative ? pilot.state_.yaw() : 0.0;
  pilot.flight_.look_at(std::nullopt);
  pilot.flight_.turn_to(wrap_to_pi(base + request.yaw));
  return {};
}

Answer Autopilot::Handler::operator()(const LookAtRequest& request) const {
  if (!pilot.flies()) return {Result::kUnsupported, "look at: this vehicle turns as it goes"};
  pilot.flight_.look_at(request.p_world_m);
  return {};
}

Answer Autopilot::Handler::operator()(const MissionStartRequest& request) const {
  if (request.first >= 0) {
    if (Answer answer = pilot.mission_.set_current(request.first); !answer.is_good()) {
      return answer;
    }
  }
  if (Answer answer = need_armed("Mission"); !answer.is_good()) return answer;
  return change_to(Mode::kMission);
}

Answer Autopilot::Handler::operator()(const MissionItemRequest& request) const {
  return pilot.mission_.set_current(request.index);
}

Answer Autopilot::Handler::operator()(const PauseRequest& request) const {
  if (!request.is_paused) return change_to(Mode::kMission);
  const Mode pause =
      pilot.options_.flavor == Flavor::kArduPilot && pilot.flies() ? Mode::kBrake : Mode::kHold;
  return change_to(pause);
}

Answer Autopilot::Handler::operator()(const FenceRequest& request) const {
  pilot.limits_.fence_is_on = request.is_on;
  pilot.report(kSeverityInfo, request.is_on ? "The fence is on." : "The fence is off.");
  return {};
}

Answer Autopilot::Handler::operator()(const HomeRequest& request) const {
  const Eigen::Vector3d home = request.p_world_m.value_or(pilot.state_.p_world_m);
  if (!home.allFinite()) return denied("home: the place is not finite");
  if (!request.p_world_m && !pilot.state_.position_stamp) return refused("home: no position yet");
  pilot.set_home(home);
  return {};
}

Answer Autopilot::Handler::operator()(const CheckRequest&) const {
  const auto problems = pilot.arming_problems(now);
  for (const std::string& problem : problems)
    pilot.report(kSeverityError, "Arming check: " + problem);
  if (!problems.empty()) return {Result::kFailed, problems.front()};
  return {};
}

Answer Autopilot::handle(const Request& request, SimTime now) {
  return std::visit(Handler{*this, now}, request);
}

/// ArduPilot's copter leaves the ground by a take-off alone.
bool Autopilot::must_take_off_before(const Target& target) const {
  return mode_ == Mode::kGuided && flight_.is_landed() && !target.thrust;
}

Answer Autopilot::set_target(const Target& target, SimTime stamp, SimTime now) {
  if (!are_finite(target.p_m, target.v_m_s, target.a_m_s2, target.w_body_rad_s, target.yaw,
                  target.yaw_rate, target.thrust)) {
    return denied("set-point: a number of it is not finite");
  }
  watch_.note_target(now);
  if (!follows_targets(mode_)) return refused("set-point: not followed in this mode");
  if (!is_armed_) return refused("set-point: the vehicle is disarmed, it must be armed");
  if (!flies()) {
    drive_.follow(target, state_, now);
    return {};
  }
  if (must_take_off_before(target)) {
    return refused("set-point: the vehicle stands on the ground, take off before");
  }
  flight_.follow(target, stamp, now);
  return {};
}

}  // namespace trident::bridges
