// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/lee_position_controller_node.h"

#include <std_msgs/Header.h>

#include <algorithm>

#include "trident_control_ros/message_conversions.h"
#include "trident_ros/schedule_fuzz.h"
#include "trident_ros/subscriptions.h"

namespace trident::control {
namespace {

const char* reason(SetpointResult result) {
  switch (result) {
    case SetpointResult::accepted:
      return "accepted";
    case SetpointResult::empty:
      return "it has no points: at least 1 is needed";
    case SetpointResult::non_finite:
      return "a position, velocity, acceleration or quaternion in it is NaN or infinite: all must "
             "be finite, and up to 1e8";
    case SetpointResult::unordered:
      return "its time_from_start decreases or is negative: it must grow from 0 or more";
    case SetpointResult::too_many_points:
      return "it has more than 65536 points";
  }
  return "unknown";
}

}  // namespace

LeePositionControllerNode::LeePositionControllerNode(ros::NodeHandle& node, const LeeParams& params,
                                                     const SetpointQueueParams& queue_params,
                                                     OdometryThread thread)
    : controller_(params),
      setpoints_(queue_params),
      motors_(node, controller_.rotor_count()),
      refusals_(node),
      accepted_(node.advertise<std_msgs::Header>("command/accepted_setpoint", 10)) {
  auto pose = ros_utils::inline_subscription<geometry_msgs::PoseStamped>(
      "command/pose", [this](const auto& message) { on_pose(*message); }, &queue_);
  auto trajectory = ros_utils::inline_subscription<trajectory_msgs::MultiDOFJointTrajectory>(
      "command/trajectory", [this](const auto& message) { on_trajectory(*message); }, &queue_);
  auto attitude = ros_utils::inline_subscription<mav_msgs::AttitudeThrust>(
      "command/attitude_thrust", [this](const auto& message) { on_part(*message, attitude_); },
      &queue_);
  auto rates = ros_utils::inline_subscription<mav_msgs::RateThrust>(
      "command/rate_thrust", [this](const auto& message) { on_part(*message, rates_); }, &queue_);
  auto stop = ros_utils::inline_subscription<std_msgs::Header>(
      "command/stop", [this](const auto& message) { on_stop(*message); }, &queue_);
  pose_ = node.subscribe(pose);
  attitude_ = node.subscribe(attitude);
  rates_ = node.subscribe(rates);
  stop_ = node.subscribe(stop);
  trajectory_ = node.subscribe(trajectory);
  odometry_ = std::make_unique<OdometryInput>(
      node, thread, [this](const StampedOdometry& odometry) { on_odometry(odometry); });
}

// Callbacks use the other members, so all subscriptions end before any member is destroyed.
LeePositionControllerNode::~LeePositionControllerNode() {
  odometry_.reset();
  for (ros::Subscriber* const subscriber : {&trajectory_, &pose_, &attitude_, &rates_, &stop_}) {
    subscriber->shutdown();
  }
}

void LeePositionControllerNode::spin_once(std::chrono::milliseconds limit) {
  odometry_->spin_once(limit);
}

// In the thread of `OdometryThread`; set-points come
// in roscpp's threads, hence the mutex in compute().
void LeePositionControllerNode::on_odometry(const StampedOdometry& odometry) {
  ros_utils::hand_over("odometry received");
  if (compute(odometry)) {
    motors_.publish(odometry.stamp);
  } else {
    refusals_.note("odometry refused", refusal_text("odometry", odometry.stamp, kInvalidStateText));
  }
}

bool LeePositionControllerNode::compute(const StampedOdometry& odometry) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const TrajectoryPoint* setpoint = setpoints_.advance(to_sim_time(odometry.stamp));
  const Span<double> speeds = motors_.rotor_speeds();
  if (setpoint) return controller_.compute(odometry.state, *setpoint, speeds) == ControlStatus::ok;
  // As in RotorS, rotors stand until the first set-point.
  std::fill(speeds.begin(), speeds.end(), 0.0);
  return true;
}

void LeePositionControllerNode::on_pose(const geometry_msgs::PoseStamped& message) {
  incoming_.assign(1, TimedSetpoint{{}, to_trajectory_point(message.pose)});
  accept(message.header, pose_.getTopic());
}

template <class Message>
void LeePositionControllerNode::on_part(const Message& message, const ros::Subscriber& subscriber) {
  incoming_.assign(1, TimedSetpoint{{}, to_trajectory_point(message)});
  accept(message.header, subscriber.getTopic());
}

void LeePositionControllerNode::on_stop(const std_msgs::Header& message) {
  TrajectoryPoint idle;
  idle.level = ControlLevel::idle;
  incoming_.assign(1, TimedSetpoint{{}, idle});
  accept(message, stop_.getTopic());
}

void LeePositionControllerNode::on_trajectory(
    const trajectory_msgs::MultiDOFJointTrajectory& message) {
  // One bad point refuses the whole message.
  if (const auto index = to_setpoints(message, incoming_)) {
    refusals_.note("set-point refused", trajectory_.getTopic() + ": set-point refused: its point " +
                                            std::to_string(*index) +
                                            " has no transform, 1 is needed");
    return;
  }
  accept(message.header, trajectory_.getTopic());
}

void LeePositionControllerNode::accept(const std_msgs::Header& header, const std::string& topic) {
  ros_utils::hand_over("set-point received");
  bool repeats = false;
  const SetpointResult result = [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    const SetpointResult pushed = setpoints_.push(to_sim_time(header.stamp), incoming_);
    repeats = setpoints_.repeats();
    return pushed;
  }();
  if (result != SetpointResult::accepted) {
    refusals_.note("set-point refused",
                   topic + ": " + refusal_text("set-point", header.stamp, reason(result)));
    return;
  }
  ros_utils::hand_over("set-point confirmed");
  // One without a stamp counts at once, and is confirmed as such.
  std_msgs::Header confirmation;
  confirmation.stamp = header.stamp;
  if (!repeats) confirmation.frame_id = topic;  // one that came again replaces nothing
  accepted_.publish(confirmation);
}

}  // namespace trident::control
