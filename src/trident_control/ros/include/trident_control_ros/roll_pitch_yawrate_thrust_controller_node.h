// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mav_msgs/RollPitchYawrateThrust.h>
#include <ros/ros.h>

#include <memory>
#include <mutex>
#include <optional>

#include "trident_control/roll_pitch_yawrate_thrust_controller.h"
#include "trident_control_ros/motor_command_publisher.h"
#include "trident_control_ros/node_main.h"
#include "trident_control_ros/odometry_input.h"
#include "trident_ros/inline_callback_queue.h"
#include "trident_ros/refusals.h"

namespace trident::control {

/// RotorS' roll_pitch_yawrate_thrust_controller_node.
/// Subscribes `odometry` and `command/roll_pitch_yawrate_thrust`; answers each odometry message
/// with one `command/motor_speed` of the same stamp, zeros until a command has come and again after
/// the world was reset (stamps that run backwards). Odometry is handled in spin_once(), or by the
/// thread of its publisher; commands on roscpp's socket thread.
class RollPitchYawrateThrustControllerNode : public RunningNode {
 public:
  /// Subscribes and advertises below `node`'s namespace. Throws Error as the controller does.
  RollPitchYawrateThrustControllerNode(ros::NodeHandle& node,
                                       const RollPitchYawrateThrustParams& params,
                                       OdometryThread thread = OdometryThread::kCaller);
  ~RollPitchYawrateThrustControllerNode() override;
  void spin_once(std::chrono::milliseconds limit) override;

 private:
  void on_odometry(const StampedOdometry& odometry);
  /// Sets the rotors' speeds; false: the odometry is refused.
  bool compute(const StampedOdometry& odometry);
  void on_command(const mav_msgs::RollPitchYawrateThrust& message);

  RollPitchYawrateThrustController controller_;
  std::mutex mutex_;
  std::optional<AttitudeCommand> command_;  // under mutex_
  ros::Time last_stamp_;

  ros_utils::InlineCallbackQueue queue_;
  MotorCommandPublisher motors_;
  ros_utils::Refusals refusals_;
  ros::Subscriber command_subscriber_;
  std::unique_ptr<OdometryInput> odometry_;
};

}  // namespace trident::control
