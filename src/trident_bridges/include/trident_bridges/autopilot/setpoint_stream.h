// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "trident_base/sim_time.h"
#include "trident_bridges/autopilot/motion.h"

namespace trident::bridges {

/// What a companion computer asks for (SET_POSITION_TARGET_LOCAL_NED and its kin), world frame; a
/// part that is not given is left to the vehicle.
struct Target {
  std::optional<Eigen::Vector3d> p_m;              ///< place
  std::optional<Eigen::Vector3d> v_m_s;            ///< velocity
  std::optional<Eigen::Vector3d> a_m_s2;           ///< acceleration
  std::optional<double> yaw;                       ///< from east [rad]
  std::optional<double> yaw_rate;                  ///< counter-clockwise [rad/s]
  std::optional<Eigen::Quaterniond> R_world_body;  ///< attitude (SET_ATTITUDE_TARGET)
  std::optional<Eigen::Vector3d> w_body_rad_s;     ///< body rates (SET_ATTITUDE_TARGET)
  std::optional<double> thrust;                    ///< 0 ... 1 (SET_ATTITUDE_TARGET)
};

/// Places that come one by one: velocity and acceleration behind them, for a controller that needs
/// both to follow without lag. An alpha-beta-gamma filter with the gains of a critically damped
/// (fading memory) one: A. L. Morrison, "Introduction to Sequential Smoothing and Prediction"
/// (1969).
class SetpointStream {
 public:
  /// Forgets what came.
  void clear() { count_ = 0; }
  /// One place, at the time of its sender's clock or of its arrival. A gap, a jump of the clock or
  /// one further than `greatest_step_m` begins again.
  void push(SimTime stamp, const Eigen::Vector3d& p_m, double greatest_step_m);
  /// Whether the places follow one another closely enough for a velocity.
  bool is_steady() const { return count_ >= 4; }
  /// The motion at the last place.
  const Reference& newest() const { return estimate_; }

 private:
  Reference estimate_;
  SimTime stamp_;
  int count_ = 0;
};

}  // namespace trident::bridges
