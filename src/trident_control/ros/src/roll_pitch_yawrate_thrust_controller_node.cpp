// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/roll_pitch_yawrate_thrust_controller_node.h"

#include <algorithm>

#include "trident_base/string_util.h"
#include "trident_control_ros/message_conversions.h"
#include "trident_ros/subscriptions.h"

namespace trident::control {

RollPitchYawrateThrustControllerNode::RollPitchYawrateThrustControllerNode(
    ros::NodeHandle& node, const RollPitchYawrateThrustParams& params, OdometryThread thread)
    : controller_(params), motors_(node, controller_.rotor_count()), refusals_(node) {
  auto command = ros_utils::inline_subscription<mav_msgs::RollPitchYawrateThrust>(
      "command/roll_pitch_yawrate_thrust", [this](const auto& message) { on_command(*message); },
      &queue_);
  command_subscriber_ = node.subscribe(command);
  odometry_ = std::make_unique<OdometryInput>(
      node, thread, [this](const StampedOdometry& odometry) { on_odometry(odometry); });
}

RollPitchYawrateThrustControllerNode::~RollPitchYawrateThrustControllerNode() {
  odometry_.reset();
  command_subscriber_.shutdown();
}

void RollPitchYawrateThrustControllerNode::spin_once(std::chrono::milliseconds limit) {
  odometry_->spin_once(limit);
}

void RollPitchYawrateThrustControllerNode::on_odometry(const StampedOdometry& odometry) {
  if (compute(odometry)) {
    motors_.publish(odometry.stamp);
  } else {
    refusals_.note("odometry refused", refusal_text("odometry", odometry.stamp, kInvalidStateText));
  }
}

bool RollPitchYawrateThrustControllerNode::compute(const StampedOdometry& odometry) {
  const std::lock_guard<std::mutex> lock(mutex_);
  // Time that runs back is a reset of the world: a run
  // must not begin with a command of the last one.
  if (odometry.stamp < last_stamp_) command_.reset();
  last_stamp_ = odometry.stamp;
  const Span<double> speeds = motors_.rotor_speeds();
  if (command_) return controller_.compute(odometry.state, *command_, speeds) == ControlStatus::ok;
  std::fill(speeds.begin(), speeds.end(), 0.0);
  return true;
}

void RollPitchYawrateThrustControllerNode::on_command(
    const mav_msgs::RollPitchYawrateThrust& message) {
  const AttitudeCommand command = to_attitude_command(message);
  if (!is_valid(command)) {
    refusals_.note("command refused",
                   command_subscriber_.getTopic() + ": command refused: roll " +
                       number_text(command.roll) + ", pitch " + number_text(command.pitch) +
                       ", yaw rate " + number_text(command.yaw_rate) + ", thrust.z " +
                       number_text(command.thrust) + ": all must be finite, and up to 1e8");
    return;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  command_ = command;
}

}  // namespace trident::control
