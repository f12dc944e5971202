// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/odometry_input.h"

#include <nav_msgs/Odometry.h>

#include <utility>

#include "trident_control_ros/node_main.h"
#include "trident_ros/message_checks.h"
#include "trident_ros/subscriptions.h"

namespace trident::control {

OdometryInput::OdometryInput(ros::NodeHandle& node, OdometryThread thread, Handler handler)
    : handler_(std::move(handler)), refusals_(node) {
  if (thread == OdometryThread::kCaller) {
    inbox_ = std::make_unique<ros_utils::DirectInbox>();
    subscription_ = inbox_->subscribe<nav_msgs::Odometry>(
        node, "odometry", 1, [this](Span<const std::uint8_t> bytes) { on_bytes(bytes); });
    return;
  }
  auto options = ros_utils::object_subscription<nav_msgs::Odometry>(
      "odometry", 1, [this](Span<const std::uint8_t> bytes) { on_bytes(bytes); },
      [this](const auto& message) { hand_over(to_stamped_odometry(*message)); }, &queue_);
  subscriber_ = node.subscribe(options);
}

OdometryInput::~OdometryInput() {
  subscription_.reset();
  subscriber_.shutdown();
}

void OdometryInput::spin_once(std::chrono::milliseconds limit) {
  if (inbox_->wait(limit)) inbox_->read();
}

// From a socket. A publisher in the same process hands over its object, which needs no parsing.
void OdometryInput::on_bytes(Span<const std::uint8_t> bytes) {
  const auto odometry = parse_odometry(bytes);
  if (!odometry) {
    refusals_.note("odometry refused",
                   "odometry of " + std::to_string(bytes.size()) +
                       " bytes is too short to be a nav_msgs/Odometry; ignored");
    return;
  }
  // A process of its own does not listen to /clock; a nodelet manager does.
  if (inbox_ && ros_utils::stamp_problem(odometry->stamp, {}).empty())
    set_log_time(odometry->stamp);
  hand_over(*odometry);
}

void OdometryInput::hand_over(const StampedOdometry& odometry) {
  const std::string problem = ros_utils::stamp_problem(odometry.stamp, {});
  if (problem.empty()) {
    handler_(odometry);
  } else {
    refusals_.note("odometry refused", "odometry refused: " + problem);
  }
}

}  // namespace trident::control
