// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Set-points between ROS (ENU, FLU) and MAVLink (NED, FRD); for sources alone, as dialect.h is.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>

#include "trident_bridges/mavlink/dialect.h"

namespace trident::mavros {

/// Set-point in a local frame. Vectors are ENU, in body frames FLU; `mask` says what is ignored:
/// POSITION_TARGET_TYPEMASK.
struct LocalTarget {
  std::uint8_t frame = MAV_FRAME_LOCAL_NED;          ///< MAV_FRAME
  std::uint16_t mask = 0;                            ///< POSITION_TARGET_TYPEMASK
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();     ///< place
  Eigen::Vector3d v_m_s = Eigen::Vector3d::Zero();   ///< velocity
  Eigen::Vector3d a_m_s2 = Eigen::Vector3d::Zero();  ///< acceleration, or force [N]
  double yaw = 0.0;             ///< from east, in body frames from ahead, counterclockwise [rad]
  double yaw_rate_rad_s = 0.0;  ///< counterclockwise
};

/// Set-point on the earth: the place of `motion` is not used.
struct GlobalTarget {
  std::uint8_t frame = MAV_FRAME_GLOBAL_INT;  ///< MAV_FRAME
  std::uint16_t mask = 0;                     ///< POSITION_TARGET_TYPEMASK
  double latitude_deg = 0.0;                  ///< [deg]
  double longitude_deg = 0.0;                 ///< [deg]
  double altitude_m = 0.0;                    ///< by the frame
  LocalTarget motion;                         ///< velocity, acceleration, yaw
};

/// Set-point of attitude, rates and thrust.
struct AttitudeSetpoint {
  std::uint8_t mask = 0;                                             ///< ATTITUDE_TARGET_TYPEMASK
  Eigen::Quaterniond R_world_body = Eigen::Quaterniond::Identity();  ///< FLU to ENU
  Eigen::Vector3d w_body_rad_s = Eigen::Vector3d::Zero();            ///< FLU
  double thrust = 0.0;                                               ///< 0 to 1
};

/// A target whose place and yaw alone count.
LocalTarget position_target(std::uint8_t frame);
/// A target whose velocity and yaw rate alone count.
LocalTarget velocity_target(std::uint8_t frame);
/// A target whose acceleration or force alone counts.
LocalTarget acceleration_target(bool is_force);

/// Whether SET_POSITION_TARGET_LOCAL_NED may have the frame.
bool is_local_frame(std::uint8_t frame);
/// MAV_FRAME of a name without its prefix. Throws Error naming it and what is legal.
std::uint8_t frame_of_name(const std::string& name);

/// What of a target counts and is no number or not on the earth; empty: nothing.
std::string problem_of(const LocalTarget& target);
std::string problem_of(const GlobalTarget& target);      ///< see above
std::string problem_of(const AttitudeSetpoint& target);  ///< see above

/// As messages, without their target.
mavlink_set_position_target_local_ned_t local_payload(const LocalTarget& target,
                                                      std::uint32_t time_boot_ms);
mavlink_set_position_target_global_int_t global_payload(const GlobalTarget& target,
                                                        std::uint32_t time_boot_ms);  ///< see above
mavlink_set_attitude_target_t attitude_payload(const AttitudeSetpoint& target,
                                               std::uint32_t time_boot_ms);  ///< see above

/// What the vehicle says that it follows.
LocalTarget local_target(const mavlink_position_target_local_ned_t& payload);
GlobalTarget global_target(const mavlink_position_target_global_int_t& payload);  ///< see above
AttitudeSetpoint attitude_target(const mavlink_attitude_target_t& payload);       ///< see above

}  // namespace trident::mavros
