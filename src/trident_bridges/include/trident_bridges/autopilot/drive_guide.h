// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "trident_bridges/autopilot/parameter_table.h"
#include "trident_bridges/autopilot/setpoint_stream.h"
#include "trident_bridges/autopilot/vehicle.h"

namespace trident::bridges {

/// Leads a ground robot or a vessel: legs to places, stations, velocities and sticks.
class DriveGuide {
 public:
  /// Limits of all that comes.
  void set_limits(const AutopilotLimits& limits) { limits_ = limits; }
  /// Along the line from where it is; the next leg begins at the last one's end.
  void go_to(const Eigen::Vector3d& p_m, const VehicleState& state);
  /// Stays where it is.
  void stop(const VehicleState& state);
  /// Stands without holding a place: no motor turns.
  void rest() { begin(Setpoint::Kind::kIdle); }
  /// A companion computer's set-point: a place, or a velocity of the world, which lasts for 3 s, as
  /// ArduPilot has it.
  void follow(const Target& target, const VehicleState& state, SimTime now);
  /// Stops where no velocity has come for too long.
  void expire(const VehicleState& state, SimTime now);
  /// A pilot's sticks: speed ahead and turn.
  void take_sticks(const Sticks& sticks);
  /// What is to be done.
  const Setpoint& setpoint() const { return setpoint_; }
  /// Whether it is within `radius_m` of the leg's end, or has passed it.
  bool has_arrived(const VehicleState& state, double radius_m) const;

 private:
  void begin(Setpoint::Kind kind);
  void follow_place(const Eigen::Vector3d& p_m, const VehicleState& state);

  AutopilotLimits limits_;
  Setpoint setpoint_;
  SimTime followed_;  // when the newest velocity came
  bool is_followed_velocity_ = false;
};

}  // namespace trident::bridges
