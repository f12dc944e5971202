// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <mav_msgs/AttitudeThrust.h>
#include <mav_msgs/RateThrust.h>
#include <ros/ros.h>
#include <std_msgs/Header.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "trident_control/lee_position_controller.h"
#include "trident_control/setpoint_queue.h"
#include "trident_control_ros/motor_command_publisher.h"
#include "trident_control_ros/node_main.h"
#include "trident_control_ros/odometry_input.h"
#include "trident_ros/inline_callback_queue.h"
#include "trident_ros/refusals.h"

namespace trident::control {

/// RotorS' lee_position_controller_node.
/// Subscribes `odometry`, `command/pose`, `command/trajectory`, and for a flight controller above
/// it `command/attitude_thrust` (mav_msgs/AttitudeThrust), `command/rate_thrust`
/// (mav_msgs/RateThrust) and `command/stop` (std_msgs/Header: the rotors stand until the next
/// set-point); answers each odometry message with one `command/motor_speed` of the same stamp,
/// zeros until a set-point acts. A stamped set-point is confirmed on `command/accepted_setpoint`
/// (std_msgs/Header: its stamp, and the topic it came on as frame_id, nothing if it repeats one)
/// once every later odometry message will see it; one without a stamp is, too, with stamp zero.
/// Time is the stamps of the odometry, nothing else. Odometry is handled in spin_once(), or by the
/// thread of its publisher; set-points on roscpp's socket thread.
class LeePositionControllerNode : public RunningNode {
 public:
  /// Subscribes and advertises below `node`'s namespace. Throws Error as the controller does.
  LeePositionControllerNode(ros::NodeHandle& node, const LeeParams& params,
                            const SetpointQueueParams& queue_params,
                            OdometryThread thread = OdometryThread::kCaller);
  ~LeePositionControllerNode() override;
  void spin_once(std::chrono::milliseconds limit) override;

 private:
  void on_odometry(const StampedOdometry& odometry);
  /// Sets the rotors' speeds; false: the odometry is refused.
  bool compute(const StampedOdometry& odometry);
  void on_pose(const geometry_msgs::PoseStamped& message);
  void on_trajectory(const trajectory_msgs::MultiDOFJointTrajectory& message);
  template <class Message>
  void on_part(const Message& message, const ros::Subscriber& subscriber);
  void on_stop(const std_msgs::Header& message);
  void accept(const std_msgs::Header& header, const std::string& topic);

  LeePositionController controller_;
  std::mutex mutex_;
  SetpointQueue setpoints_;              // under mutex_
  std::vector<TimedSetpoint> incoming_;  // reused

  ros_utils::InlineCallbackQueue queue_;
  MotorCommandPublisher motors_;
  ros_utils::Refusals refusals_;
  ros::Publisher accepted_;
  ros::Subscriber pose_;
  ros::Subscriber trajectory_;
  ros::Subscriber attitude_;
  ros::Subscriber rates_;
  ros::Subscriber stop_;
  std::unique_ptr<OdometryInput> odometry_;
};

}  // namespace trident::control
