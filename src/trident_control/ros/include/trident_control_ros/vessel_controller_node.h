// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "trident_control/vessel_controller.h"
#include "trident_control_ros/motor_command_publisher.h"
#include "trident_control_ros/node_main.h"
#include "trident_control_ros/odometry_input.h"
#include "trident_ros/inline_callback_queue.h"

namespace trident::control {

/// A vessel's controllers as a node.
/// Subscribes `odometry`, `cmd_vel` (geometry_msgs/Twist: surge speed, yaw rate),
/// `command/heading`, `command/course` [rad], `command/speed` [m/s] (std_msgs/Float64),
/// `command/path` (nav_msgs/Path), `command/pose` (geometry_msgs/PoseStamped: station) and
/// `speed_through_water` (std_msgs/Float64, of a log). What counts by its stamp: `command/velocity`
/// (geometry_msgs/TwistStamped) as `cmd_vel`, `command/cruise` (geometry_msgs/TwistStamped, its
/// linear.x) as `command/speed`, `command/stop` (std_msgs/Header): the thrusters stand until the
/// next command. The newest command decides what is done; places are in the frame of the odometry.
/// Answers each odometry message with one `command/motor_speed` (mav_msgs/Actuators) of the same
/// stamp, all commands of ThrustAllocation::topics(), which keeps lockstep with the simulator, and
/// publishes each on its own topic for any listener: thrusters as std_msgs/Float32, rudders as
/// Float64. What has a stamp is confirmed on `command/accepted_setpoint`, as by the controllers of
/// multirotors. `cross_track_error` [m] is the distance from the path. What was wrong with a
/// command is logged once and counted on /diagnostics.
class VesselControllerNode : public RunningNode {
 public:
  /// Subscribes and advertises below `node`'s namespace. Throws Error as VesselController does.
  VesselControllerNode(ros::NodeHandle& node, const VesselModel& model,
                       const VesselControlParams& params);
  ~VesselControllerNode() override;
  void spin_once(std::chrono::milliseconds limit) override;

 private:
  struct Problem {
    bool is_error = false;
    std::uint64_t count = 0;
    std::string newest;
  };

  template <class Message, class Convert>
  void listen(ros::NodeHandle& node, const std::string& topic, const Convert& convert);
  void listen_to_commands(ros::NodeHandle& node);
  void listen_to_stamped_commands(ros::NodeHandle& node);
  void accept(const std::string& topic, const ros::Time& stamp, const VesselCommand& command);
  void note(const std::string& kind, bool is_error, const std::string& text);
  void on_odometry(const StampedOdometry& odometry);
  void publish_single();
  void publish_diagnostics();

  VesselController controller_;
  std::mutex mutex_;
  SimTime now_;                              // under mutex_, of the last odometry
  std::map<std::string, Problem> problems_;  // under mutex_
  SimTime published_at_{-1'000'000'000};

  ros_utils::InlineCallbackQueue queue_;
  MotorCommandPublisher motors_;
  std::vector<ros::Publisher> single_;
  std::string name_;
  ros::Publisher accepted_, cross_track_, diagnostics_;
  std::vector<ros::Subscriber> subscribers_;
  std::unique_ptr<OdometryInput> odometry_;
};

}  // namespace trident::control
