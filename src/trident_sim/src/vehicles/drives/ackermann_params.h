// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/plugins/model_params.h"
#include "trident_base/vehicle/bicycle_odometry.h"

namespace trident::sim {

/// What a car is made of. Pairs are left, right.
struct AckermannSpec {
  std::array<Joint*, 2> front, rear, steering;  ///< front and steering may be the same
  Joint* steering_wheel = nullptr;
  AckermannGeometry geometry;
  double wheel_radius_m = 0.0;
  SE2 T_base_axle;  ///< of the middle of the rear axle, pointing ahead

  double max_speed = 0.0;  ///< [m/s]
  double max_steer_rad = 0.0;
  double steering_wheel_ratio = 1.0;  ///< steering of the wheels per turn of the steering wheel
  bool turn_is_yaw_rate = false;      ///< angular.z is a yaw rate, else the steering angle

  /// As efforts, as upstream; none: ODE's motors, which need no tuning
  std::array<std::optional<PidGains>, 2> steering_gains;
  std::optional<PidGains> speed_gains;
  double drive_torque = 0.0, steering_torque = 0.0;  ///< limits of the motors of one wheel [N m]
  double acceleration = 0.0;                         ///< of the motors [m/s^2]; 0: at once
  double steering_speed = 0.0;                       ///< of the motors [rad/s]; 0: at once

  double rate_hz = 0.0;
  std::string command_topic, distance_topic;
  OdometryNames odometry;
  bool with_odometry = false, with_odometry_transform = false, with_distance = false;
  bool with_wheel_transforms = false, with_joint_states = false;
  bool from_encoders = false;
  BicycleOdometryParams encoders;
  double covariance_x = 0.0, covariance_y = 0.0, covariance_yaw = 0.0;
};

/// From the elements of libgazebo_ros_ackermann_drive.so. Throws Error for one that is missing or
/// out of range; reports what contradicts the places of the wheels or the limits of their joints.
AckermannSpec read_ackermann(const PluginContext& context);

}  // namespace trident::sim
