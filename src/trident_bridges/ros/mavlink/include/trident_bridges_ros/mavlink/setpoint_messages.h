// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// An autopilot's set-point as the messages that vehicles' controllers take.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <mav_msgs/AttitudeThrust.h>
#include <mav_msgs/RateThrust.h>
#include <nav_msgs/Path.h>
#include <std_msgs/Header.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <string>

#include "trident_base/se3.h"
#include "trident_base/sim_time.h"
#include "trident_bridges/autopilot/vehicle.h"

namespace trident::bridges {

/// When a set-point counts, and in which frame its places are.
std_msgs::Header setpoint_header(SimTime stamp, const std::string& frame);

/// The same set-point with its places, directions and headings in another frame, of which
/// `T_frame_world` takes coordinates there.
Setpoint in_frame(const Setpoint& setpoint, const SE3& T_frame_world);

/// Of kTrajectory: one point.
trajectory_msgs::MultiDOFJointTrajectory to_trajectory(const Setpoint& setpoint,
                                                       const std_msgs::Header& header);
/// Of kAttitude. `max_thrust_N`: of all rotors together.
mav_msgs::AttitudeThrust to_attitude_thrust(const Setpoint& setpoint, double max_thrust_N,
                                            const std_msgs::Header& header);
/// Of kRates. `max_thrust_N`: of all rotors together.
mav_msgs::RateThrust to_rate_thrust(const Setpoint& setpoint, double max_thrust_N,
                                    const std_msgs::Header& header);
/// Of kDrive: speed ahead and rate of turn.
geometry_msgs::TwistStamped to_velocity(const Setpoint& setpoint, const std_msgs::Header& header);
/// Of kLeg: the speed along it.
geometry_msgs::TwistStamped to_cruise(const Setpoint& setpoint, const std_msgs::Header& header);
/// Of kLeg: from its begin to its end.
nav_msgs::Path to_path(const Setpoint& setpoint, const std_msgs::Header& header);
/// Of kStation.
geometry_msgs::PoseStamped to_station(const Setpoint& setpoint, const std_msgs::Header& header);

}  // namespace trident::bridges
