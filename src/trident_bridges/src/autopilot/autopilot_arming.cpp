// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "autopilot/texts.h"
#include "trident_base/string_util.h"
#include "trident_bridges/autopilot/autopilot.h"

namespace trident::bridges {
namespace {

constexpr double kOldPosition_s = 1.0;
constexpr double kSettled_m = 1.0;  // standard deviation of the place
constexpr double kStanding_m_s = 0.5;

std::optional<std::string> position_problem(const VehicleState& state, SimTime now) {
  if (!state.position_stamp) return "position: none has come";
  const double age_s = (now - *state.position_stamp).seconds();
  if (age_s <= kOldPosition_s) return std::nullopt;
  return "position: " + number_text(age_s) + " s old, limit " + number_text(kOldPosition_s) + " s";
}

std::optional<std::string> estimator_problem(const VehicleState& state) {
  if (state.position_stddev_m <= kSettled_m) return std::nullopt;
  return "estimator: standard deviation " + number_text(state.position_stddev_m) + " m, limit " +
         number_text(kSettled_m) + " m";
}

std::optional<std::string> battery_problem(const VehicleState& state, double least) {
  if (!(state.battery < least)) return std::nullopt;
  return "battery: " + percent_text(state.battery) + ", limit " + percent_text(least);
}

/// A vessel drifts in waves and current.
std::optional<std::string> speed_problem(const VehicleState& state, VehicleClass vehicle) {
  const double speed = state.v_world_m_s.norm();
  if (vehicle == VehicleClass::kVessel || !(speed > kStanding_m_s)) return std::nullopt;
  return "speed: " + number_text(speed) + " m/s, limit " + number_text(kStanding_m_s) + " m/s";
}

std::optional<std::string> problem_of_mode(const AutopilotOptions& options, Mode mode) {
  if (!prevents_arming(mode)) return std::nullopt;
  const ModeEntry* const entry = find_mode(options.flavor, options.vehicle, mode);
  return std::string("mode: ") + entry->name + " cannot be armed in";
}

}  // namespace

/// What a place breaks while the fence is on.
std::optional<std::string> Autopilot::fence_problem(const Eigen::Vector3d& p_world_m) const {
  return limits_.fence_is_on ? fence_.breach(p_world_m) : std::nullopt;
}

std::vector<std::string> Autopilot::arming_problems(SimTime now) const {
  const std::optional<std::string> checks[] = {
      position_problem(state_, now),
      estimator_problem(state_),
      battery_problem(state_, limits_.arming_battery),
      state_.position_stamp ? fence_problem(state_.p_world_m) : std::nullopt,
      speed_problem(state_, options_.vehicle),
      problem_of_mode(options_, mode_)};
  std::vector<std::string> problems;
  for (const auto& problem : checks) {
    if (problem) problems.push_back(*problem);
  }
  return problems;
}

/// Reports everything that stands against arming; refused if there is something.
Answer Autopilot::check_arming(SimTime now) {
  if (!limits_.checks_arming) return {};
  const auto problems = arming_problems(now);
  for (const std::string& problem : problems) report(kSeverityError, "Arming denied: " + problem);
  if (!problems.empty()) return refused("Arming denied: " + problems.front());
  return {};
}

Answer Autopilot::disarm_on_request(bool is_forced) {
  if (!is_landed() && !is_forced) {
    return refused("Disarming: the vehicle is in the air, it must have landed");
  }
  disarm(is_forced ? "forced" : "asked for");
  return {};
}

Answer Autopilot::arm(const ArmRequest& request, SimTime now) {
  if (request.is_armed == is_armed_) return {};
  if (!request.is_armed) return disarm_on_request(request.is_forced);
  Answer answer = request.is_forced ? Answer() : check_arming(now);
  if (answer.is_good()) become_armed(request.is_forced ? "Armed, forced." : "Armed.", now);
  return answer;
}

void Autopilot::become_armed(const std::string& report_text, SimTime now) {
  is_armed_ = true;
  set_home(state_.p_world_m);
  flight_.start(now, state_);
  report(kSeverityInfo, report_text);
  if (mode_ == Mode::kMission || !flies()) begin(mode_, now);
}

}  // namespace trident::bridges
