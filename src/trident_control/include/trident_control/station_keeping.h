// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "trident_control/limited_integral.h"
#include "trident_control/vessel_control_params.h"
#include "trident_control/vessel_model.h"

namespace trident::control {

/// Holds a place with a vessel that can push in every direction: a PID on the distance, whose
/// integral is kept in the world's axes, where wind and current are steady.
class PlaceHold {
 public:
  /// The gains follow from the model's mass and damping; both are copied.
  PlaceHold(const StationParams& params, const VesselModel& model);

  /// Forgets the integral: wind and current are learnt again.
  void reset();
  /// Surge and sway force [N].
  Eigen::Vector2d hold(const VesselState& state, const Eigen::Vector2d& place_world, double dt_s);
  /// What the actuators gave of the last force, surge and sway [N]; the integral continues from it.
  void settle(const Eigen::Vector2d& given);

 private:
  StationParams params_;
  VesselModel model_;
  double heading_ = 0.0, dt_s_ = 0.0;
  Eigen::Vector2d error_world_ = Eigen::Vector2d::Zero(), asked_ = Eigen::Vector2d::Zero();
  LimitedIntegral east_, north_;  // along the world's x and y
};

/// Keeps a vessel at a place that cannot push sideways: it hangs like a pendulum on a point at a
/// distance ahead, at which it looks, so that wind and current turn its bow into them; the point is
/// moved until the vessel is where it should be (weather-optimal positioning, Fossen and Strand
/// 2001). Its heading is the weather's choice.
class WeatherVane {
 public:
  /// What autopilot and speed controller are to follow.
  struct Setpoint {
    double heading = 0.0;  ///< [rad]
    double speed = 0.0;    ///< [m/s]
  };

  /// start() must come before update().
  explicit WeatherVane(const StationParams& params) : params_(params) {}

  /// Hangs it where it would be at the place if it continued straight to there.
  void start(const VesselState& state, const Eigen::Vector2d& place_world);
  /// Moves the point towards where the vessel would be on station, and returns how to look at it.
  Setpoint update(const VesselState& state, const Eigen::Vector2d& place_world, double dt_s);
  /// Where the vessel hangs.
  const Eigen::Vector2d& suspension() const { return point_; }

 private:
  StationParams params_;
  Eigen::Vector2d point_ = Eigen::Vector2d::Zero();
};

}  // namespace trident::control
