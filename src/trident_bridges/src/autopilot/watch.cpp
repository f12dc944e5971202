// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/watch.h"

#include <algorithm>
#include <cmath>

#include "autopilot/texts.h"
#include "trident_base/string_util.h"

namespace trident::bridges {
namespace {

constexpr double kStickAge_s = 1.0;
constexpr double kTargetGap_s = 0.5;      // more than 2 Hz
constexpr double kTargetsBefore_s = 1.0;  // before OFFBOARD
constexpr int kNothing = 0;

/// The mode of an action's number (GF_ACTION's).
std::optional<Mode> mode_of_action(int action, VehicleClass vehicle) {
  if (action == 2) return Mode::kHold;
  if (action == 3) return Mode::kReturn;
  if (action == 5) return vehicle == VehicleClass::kMultirotor ? Mode::kLand : Mode::kHold;
  return std::nullopt;
}

double deflection(const Sticks& sticks) {
  return std::max({std::abs(sticks.pitch), std::abs(sticks.roll), std::abs(sticks.yaw),
                   2.0 * std::abs(sticks.throttle - 0.5)});
}

}  // namespace

void Watch::note_ground_station(SimTime now) { ground_station_ = now; }

void Watch::note_target(SimTime now) {
  const bool continues = target_ && now >= *target_ && (now - *target_).seconds() < kTargetGap_s;
  if (!continues) targets_since_ = now;
  target_ = now;
}

void Watch::keep_targets(SimTime when) {
  if (target_ && when > *target_) note_target(when);
}

void Watch::note_sticks(const Sticks& sticks, SimTime now) {
  sticks_ = sticks;
  sticks_at_ = now;
}

std::optional<Sticks> Watch::sticks(SimTime now) const {
  if (!sticks_at_ || (now - *sticks_at_).seconds() > kStickAge_s) return std::nullopt;
  return sticks_;
}

std::optional<std::string> Watch::offboard_problem(SimTime now) const {
  const std::string rule = "OFFBOARD: set-points must come at more than 2 Hz for 1 s before: ";
  if (!target_) return rule + "none has come";
  const double age = (now - *target_).seconds();
  if (age >= kTargetGap_s) return rule + "the last is " + number_text(age) + " s old";
  const double streaming = (now - *targets_since_).seconds();
  if (streaming >= kTargetsBefore_s) return std::nullopt;
  return rule + "they have come for " + number_text(streaming) + " s";
}

bool Watch::is_offboard_near(SimTime now) const {
  return target_ && (now - *target_).seconds() < kTargetGap_s &&
         (now - *targets_since_).seconds() < kTargetsBefore_s;
}

bool Watch::has_targets(SimTime now, const AutopilotLimits& limits) const {
  return target_ && (now - *target_).seconds() <= limits.offboard_loss_s;
}

std::optional<FailsafeAction> Watch::check(SimTime now, const WatchedVehicle& vehicle,
                                           const AutopilotLimits& limits, const Fence& fence) {
  if (!vehicle.is_armed) {
    battery_stage_ = 0;
    return std::nullopt;
  }
  if (auto action = check_battery(vehicle, limits)) return action;
  if (auto action = check_fence(vehicle, limits, fence)) return action;
  if (auto action = check_sticks(now, vehicle, limits)) return action;
  if (auto action = check_offboard(now, vehicle, limits)) return action;
  return check_ground_station(now, vehicle, limits);
}

std::optional<FailsafeAction> Watch::check_battery(const WatchedVehicle& vehicle,
                                                   const AutopilotLimits& limits) {
  const double battery = vehicle.state.battery;
  if (!(battery < limits.low_battery)) return std::nullopt;
  if (battery < limits.critical_battery && battery_stage_ < 2) {
    battery_stage_ = 2;
    return FailsafeAction{mode_of_action(5, vehicle.vehicle),
                          "battery " + percent_text(battery) + ", critical below " +
                              percent_text(limits.critical_battery)};
  }
  if (battery_stage_ >= 1) return std::nullopt;
  battery_stage_ = 1;
  return FailsafeAction{Mode::kReturn, "battery " + percent_text(battery) + ", low below " +
                                           percent_text(limits.low_battery)};
}

std::optional<FailsafeAction> Watch::check_fence(const WatchedVehicle& vehicle,
                                                 const AutopilotLimits& limits,
                                                 const Fence& fence) {
  const auto breach = limits.fence_is_on ? fence.breach(vehicle.state.p_world_m) : std::nullopt;
  const bool was_broken = fence_is_broken_;
  fence_is_broken_ = breach.has_value();
  if (!breach || was_broken || limits.fence_action == kNothing) return std::nullopt;
  return FailsafeAction{mode_of_action(limits.fence_action, vehicle.vehicle), *breach};
}

std::optional<FailsafeAction> Watch::check_offboard(SimTime now, const WatchedVehicle& vehicle,
                                                    const AutopilotLimits& limits) {
  if (vehicle.mode != Mode::kOffboard || has_targets(now, limits)) return std::nullopt;
  const double age = target_ ? (now - *target_).seconds() : 0.0;
  const std::string text = "OFFBOARD: no set-point for " + number_text(age) + " s, limit " +
                           number_text(limits.offboard_loss_s) + " s";
  // Position hold where a pilot is there to take over, else back.
  return FailsafeAction{sticks(now) ? Mode::kHold : Mode::kReturn, text};
}

std::optional<FailsafeAction> Watch::check_ground_station(SimTime now,
                                                          const WatchedVehicle& vehicle,
                                                          const AutopilotLimits& limits) {
  const bool was_lost = ground_station_is_lost_;
  const double age = ground_station_ ? (now - *ground_station_).seconds() : 0.0;
  ground_station_is_lost_ = age > limits.ground_station_loss_s;
  if (!ground_station_is_lost_ || was_lost) return std::nullopt;
  const int action = limits.ground_station_loss_action;
  if (action == kNothing) return std::nullopt;
  return FailsafeAction{mode_of_action(action, vehicle.vehicle),
                        "ground station silent for " + number_text(age) + " s, limit " +
                            number_text(limits.ground_station_loss_s) + " s"};
}

std::optional<FailsafeAction> Watch::check_sticks(SimTime now, const WatchedVehicle& vehicle,
                                                  const AutopilotLimits& limits) {
  if (!limits.sticks_override || is_manual(vehicle.mode)) return std::nullopt;
  const auto newest = sticks(now);
  if (!newest || deflection(*newest) <= limits.stick_dead_band) return std::nullopt;
  const bool flies = vehicle.vehicle == VehicleClass::kMultirotor;
  return FailsafeAction{flies ? Mode::kPosition : Mode::kManual,
                        "sticks moved by " + percent_text(deflection(*newest)) + ", limit " +
                            percent_text(limits.stick_dead_band) +
                            ": the pilot has it; a change of mode gives it back"};
}

}  // namespace trident::bridges
