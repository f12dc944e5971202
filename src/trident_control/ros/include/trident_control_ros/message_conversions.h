// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <mav_msgs/AttitudeThrust.h>
#include <mav_msgs/RateThrust.h>
#include <mav_msgs/RollPitchYawrateThrust.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_base/span.h"
#include "trident_control/control_types.h"
#include "trident_control/setpoint_queue.h"

namespace trident::control {

/// What a controller reads of a nav_msgs/Odometry.
struct StampedOdometry {
  ros::Time stamp;      ///< of the state; the answer carries it
  OdometryState state;  ///< not checked; see is_valid()
};

/// Why a controller refuses a state; ends a sentence.
inline constexpr const char* kInvalidStateText =
    "a number in it is NaN, infinite or beyond 1e8, or its orientation is no unit quaternion; it "
    "gets no "
    "answer";

/// "what stamped s refused: why".
std::string refusal_text(const std::string& what, const ros::Time& stamp, const std::string& why);

/// Exact: both count nanoseconds.
SimTime to_sim_time(const ros::Time& time);
/// Exact, negative durations included.
SimTime to_sim_time(const ros::Duration& duration);

/// Reads a serialised nav_msgs/Odometry; nullopt when the bytes end too early.
std::optional<StampedOdometry> parse_odometry(Span<const std::uint8_t> bytes);

/// The same of a message object. Covariances and frames are ignored.
StampedOdometry to_stamped_odometry(const nav_msgs::Odometry& message);

/// At rest at the pose's position, with its yaw.
TrajectoryPoint to_trajectory_point(const geometry_msgs::Pose& pose);

/// Missing velocities or accelerations are zero. nullopt when there is no transform. Only the first
/// joint is read: a multirotor is one body.
std::optional<TrajectoryPoint> to_trajectory_point(
    const trajectory_msgs::MultiDOFJointTrajectoryPoint& point);

/// Level attitude; of the thrust vector only the part along body z counts.
TrajectoryPoint to_trajectory_point(const mav_msgs::AttitudeThrust& message);

/// Level rates; of the thrust vector only the part along body z counts.
TrajectoryPoint to_trajectory_point(const mav_msgs::RateThrust& message);

/// Converts every point into `out` (reused). Returns the index of a point without transform, or
/// nullopt.
std::optional<std::size_t> to_setpoints(const trajectory_msgs::MultiDOFJointTrajectory& message,
                                        std::vector<TimedSetpoint>& out);

/// Of the thrust vector only the part along body z counts.
AttitudeCommand to_attitude_command(const mav_msgs::RollPitchYawrateThrust& message);

}  // namespace trident::control
