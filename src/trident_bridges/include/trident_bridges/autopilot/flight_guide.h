// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "trident_bridges/autopilot/modes.h"
#include "trident_bridges/autopilot/motion.h"
#include "trident_bridges/autopilot/parameter_table.h"
#include "trident_bridges/autopilot/setpoint_stream.h"
#include "trident_bridges/autopilot/vehicle.h"

namespace trident::bridges {

/// Leads a multirotor: turns places, velocities, circles, sticks and landings into references that
/// a position controller follows, and finds out when it stands on the ground again.
class FlightGuide {
 public:
  /// Begins where the vehicle is, at rest; its heading stays.
  void start(SimTime now, const VehicleState& state);
  /// Limits of all that comes.
  void set_limits(const AutopilotLimits& limits) { limits_ = limits; }

  /// To rest at a place.
  void go_to(const Eigen::Vector3d& p_m, SimTime now);
  /// To rest as soon as may be.
  void brake(SimTime now);
  /// Around a center, clockwise for a positive radius; begins at the point next to it.
  void circle(const Eigen::Vector3d& center_m, double radius_m, double turns, SimTime now);
  /// Straight down until it stands.
  void land(SimTime now);
  /// Heading from now on; none: stays.
  void turn_to(double yaw) { yaw_goal_ = yaw; }
  /// Heading towards a place from now on; none: no longer.
  void look_at(const std::optional<Eigen::Vector3d>& p_m) { look_at_ = p_m; }
  /// Turns towards where a leg leads, as missions do.
  void look_along(const Eigen::Vector3d& goal_m, SimTime now);
  /// A companion computer's set-point.
  void follow(const Target& target, SimTime stamp, SimTime now);
  /// A pilot's sticks in a mode that takes them.
  void take_sticks(const Sticks& sticks, Mode mode, SimTime now);

  /// One step; `state` is that of `now`.
  Setpoint step(SimTime now, const VehicleState& state);
  /// Whether the reference rests and the vehicle is within `radius_m` of it.
  bool has_arrived(SimTime now, const VehicleState& state, double radius_m) const;
  /// Whether it stands on the ground.
  bool is_landed() const { return landing_.is_done; }
  /// For how long it has [s].
  double landed_s(SimTime now) const;

 private:
  struct Circle {
    Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
    double radius_m = 0.0;
    double turns_left = 0.0;
    double angle = 0.0;
    double speed_m_s = 0.0;
    bool is_begun = false;  // the vehicle has come to its edge
  };
  struct Landing {
    double ground_m = 0.0;  // where it stood last
    bool is_active = false;
    bool is_done = true;
    std::optional<SimTime> still_since;  // it sinks no more though it should
    std::optional<SimTime> done_at;
  };
  MotionLimits motion_limits() const;
  Eigen::Vector3d limited(const Eigen::Vector3d& v_m_s) const;
  void leave_others();
  void follow_directly(const Target& target);
  void follow_place(const Target& target, SimTime stamp, SimTime now);
  void advance_circle(SimTime now, double step_s);
  void sink(SimTime now, const VehicleState& state);
  void advance_yaw(const VehicleState& state, double step_s);
  void watch_ground(SimTime now, const VehicleState& state);
  void watch_touchdown(SimTime now, const VehicleState& state);

  AutopilotLimits limits_;
  Motion motion_;
  SetpointStream stream_;
  std::optional<Circle> circle_;
  std::optional<Setpoint> direct_;  // attitudes and rates, handed on as they came
  std::optional<Eigen::Vector3d> look_at_;
  double yaw_ = 0.0;
  double yaw_rate_ = 0.0;
  double yaw_goal_ = 0.0;
  std::optional<double> wanted_yaw_rate_;
  Eigen::Vector3d streamed_acceleration_ = Eigen::Vector3d::Zero();
  std::optional<SimTime> news_until_;  // then a companion computer's motion ends
  Landing landing_;
  std::optional<SimTime> last_step_;
};

}  // namespace trident::bridges
