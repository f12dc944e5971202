// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Topic names of one vehicle, relative to its namespace.
namespace mav_msgs {
namespace default_topics {

// Measurements.
static constexpr char IMU[] = "imu";                        ///< sensor_msgs/Imu
static constexpr char MOTOR_MEASUREMENT[] = "motor_speed";  ///< mav_msgs/Actuators
static constexpr char MAGNETIC_FIELD[] = "magnetic_field";  ///< sensor_msgs/MagneticField
static constexpr char GPS[] = "gps";                        ///< sensor_msgs/NavSatFix
static constexpr char RC[] = "rc";
static constexpr char STATUS[] = "status";
static constexpr char AIR_SPEED[] = "air_speed";
static constexpr char GROUND_SPEED[] = "ground_speed";

// Commands.
static constexpr char COMMAND_ACTUATORS[] = "command/motor_speed";    ///< mav_msgs/Actuators
static constexpr char COMMAND_RATE_THRUST[] = "command/rate_thrust";  ///< mav_msgs/RateThrust
static constexpr char COMMAND_ROLL_PITCH_YAWRATE_THRUST[] = "command/roll_pitch_yawrate_thrust";
/// Mav_msgs/AttitudeThrust.
static constexpr char COMMAND_ATTITUDE_THRUST[] = "command/attitude_thrust";
static constexpr char COMMAND_TRAJECTORY[] = "command/trajectory";
static constexpr char COMMAND_POSE[] = "command/pose";  ///< geometry_msgs/PoseStamped
static constexpr char COMMAND_GPS_WAYPOINT[] = "command/gps_waypoint";

// State estimates.
static constexpr char POSE[] = "pose";  ///< geometry_msgs/PoseStamped
/// Geometry_msgs/PoseWithCovarianceStamped.
static constexpr char POSE_WITH_COVARIANCE[] = "pose_with_covariance";
static constexpr char TRANSFORM[] = "transform";  ///< geometry_msgs/TransformStamped
static constexpr char ODOMETRY[] = "odometry";    ///< nav_msgs/Odometry
static constexpr char POSITION[] = "position";    ///< geometry_msgs/PointStamped

// Simulation only.
static constexpr char WRENCH[] = "wrench";
static constexpr char WIND_SPEED[] = "wind_speed";
static constexpr char EXTERNAL_FORCE[] = "external_force";
static constexpr char GROUND_TRUTH_POSE[] = "ground_truth/pose";
static constexpr char GROUND_TRUTH_TWIST[] = "ground_truth/twist";

}  // namespace default_topics
}  // namespace mav_msgs
