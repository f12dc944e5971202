// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <optional>

#include "trident_base/sim_time.h"

namespace trident::bridges {

/// How a vehicle moves, which decides its modes and its set-points.
enum class VehicleClass { kMultirotor, kGround, kVessel };

/// Whose modes, parameters and rules a vehicle shows to its ground station.
enum class Flavor { kPx4, kArduPilot };

/// What a vehicle's sensors and estimator said last. The world frame is east, north, up, its origin
/// the place where the estimator began.
struct VehicleState {
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();               ///< place
  Eigen::Vector3d v_world_m_s = Eigen::Vector3d::Zero();             ///< velocity
  Eigen::Quaterniond R_world_body = Eigen::Quaterniond::Identity();  ///< body: forward, left, up
  std::optional<SimTime> position_stamp;  ///< of the place; none: it is not known yet
  /// Filling of the battery, 0 to 1; NaN: the vehicle has none that anybody reports.
  double battery = std::numeric_limits<double>::quiet_NaN();
  /// Standard deviation of the horizontal place [m]; 0 where the estimator does not say.
  double position_stddev_m = 0.0;

  /// Heading: angle of body x from east, counter-clockwise [rad].
  double yaw() const;
};

/// A pilot's sticks, or those of a ground station (MANUAL_CONTROL, RC_CHANNELS_OVERRIDE).
struct Sticks {
  double pitch = 0.0;     ///< -1 ... 1, positive: forward
  double roll = 0.0;      ///< -1 ... 1, positive: right
  double yaw = 0.0;       ///< -1 ... 1, positive: clockwise seen from above
  double throttle = 0.5;  ///< 0 ... 1; 0.5 keeps the height where the mode does
};

/// What the vehicle's controllers shall do from now on.
struct Setpoint {
  /// Which fields count.
  enum class Kind {
    kIdle,        ///< motors stand; the vehicle is disarmed
    kTrajectory,  ///< of a multirotor: p_m, v_m_s, a_m_s2, yaw, yaw_rate
    kAttitude,    ///< of a multirotor: R_world_body, yaw_rate, thrust
    kRates,       ///< of a multirotor: w_body_rad_s, thrust
    kDrive,       ///< of others: speed_m_s ahead, yaw_rate
    kLeg,         ///< of others: from p_from_m to p_m with speed_m_s
    kStation,     ///< of others: stay at p_m
  };
  Kind kind = Kind::kIdle;                                           ///< which of them
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();                     ///< place, world
  Eigen::Vector3d p_from_m = Eigen::Vector3d::Zero();                ///< begin of a leg, world
  Eigen::Vector3d v_m_s = Eigen::Vector3d::Zero();                   ///< velocity, world
  Eigen::Vector3d a_m_s2 = Eigen::Vector3d::Zero();                  ///< acceleration, world
  Eigen::Quaterniond R_world_body = Eigen::Quaterniond::Identity();  ///< attitude
  Eigen::Vector3d w_body_rad_s = Eigen::Vector3d::Zero();            ///< rates
  double yaw = 0.0;                                                  ///< from east [rad]
  double yaw_rate = 0.0;                                             ///< counter-clockwise [rad/s]
  double speed_m_s = 0.0;                                            ///< negative: astern
  double thrust = 0.0;                                               ///< 0 ... 1 of all rotors
};

}  // namespace trident::bridges
