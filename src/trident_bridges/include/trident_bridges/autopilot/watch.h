// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "trident_base/sim_time.h"
#include "trident_bridges/autopilot/fence.h"
#include "trident_bridges/autopilot/modes.h"
#include "trident_bridges/autopilot/parameter_table.h"
#include "trident_bridges/autopilot/vehicle.h"

namespace trident::bridges {

/// What a failsafe does.
struct FailsafeAction {
  std::optional<Mode> mode;  ///< to be entered; none: it is only reported
  std::string text;          ///< rule, value and limit
};

/// What the failsafes look at.
struct WatchedVehicle {
  Mode mode = Mode::kHold;                           ///< the present one
  bool is_armed = false;                             ///< nothing is done to one that is not
  bool is_landed = true;                             ///< nothing is done to one that is
  VehicleClass vehicle = VehicleClass::kMultirotor;  ///< whether it can land
  VehicleState state;                                ///< where it is, its battery
};

/// When who was heard, and what follows from silence, an empty battery and a broken fence. Each
/// failsafe acts once, and again only after its cause had gone.
class Watch {
 public:
  /// A ground station's heartbeat.
  void note_ground_station(SimTime now);
  /// A set-point of a companion computer.
  void note_target(SimTime now);
  /// What counts as a set-point at that time, which may be later than that of the last: its sender
  /// has another clock. Nothing where none has come.
  void keep_targets(SimTime when);
  /// Sticks.
  void note_sticks(const Sticks& sticks, SimTime now);

  /// The newest sticks that are not older than 1 s.
  std::optional<Sticks> sticks(SimTime now) const;
  /// Whether set-points came at more than 2 Hz for the last second, which PX4 asks before OFFBOARD;
  /// else why not.
  std::optional<std::string> offboard_problem(SimTime now) const;
  /// Whether nothing is wrong with the set-points but that they have not come for 1 s yet.
  bool is_offboard_near(SimTime now) const;
  /// Whether set-points have not been missing for longer than allowed.
  bool has_targets(SimTime now, const AutopilotLimits& limits) const;

  /// What has to be done now, the gravest first; nothing is left of it afterwards.
  std::optional<FailsafeAction> check(SimTime now, const WatchedVehicle& vehicle,
                                      const AutopilotLimits& limits, const Fence& fence);

 private:
  std::optional<FailsafeAction> check_battery(const WatchedVehicle& vehicle,
                                              const AutopilotLimits& limits);
  std::optional<FailsafeAction> check_fence(const WatchedVehicle& vehicle,
                                            const AutopilotLimits& limits, const Fence& fence);
  std::optional<FailsafeAction> check_offboard(SimTime now, const WatchedVehicle& vehicle,
                                               const AutopilotLimits& limits);
  std::optional<FailsafeAction> check_ground_station(SimTime now, const WatchedVehicle& vehicle,
                                                     const AutopilotLimits& limits);
  std::optional<FailsafeAction> check_sticks(SimTime now, const WatchedVehicle& vehicle,
                                             const AutopilotLimits& limits);

  std::optional<SimTime> ground_station_;
  std::optional<SimTime> target_;
  std::optional<SimTime> targets_since_;  // without a gap of 0.5 s
  std::optional<SimTime> sticks_at_;
  Sticks sticks_;
  int battery_stage_ = 0;  // 1: low, 2: critical was acted upon
  bool fence_is_broken_ = false;
  bool ground_station_is_lost_ = false;
};

}  // namespace trident::bridges
