// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/odometry_input.h"

#include <nav_msgs/Odometry.h>

#include <utility>

#include "trident_control_ros/node_main.h"
#include "trident_ros/subscriptions.h"

namespace trident {

OdometryInput::OdometryInput(ros::NodeHandle& node, OdometryThread thread, Handler handler)
    : handler_(std::move(handler)) {
  if (thread == OdometryThread::kCaller) {
    inbox_ = std::make_unique<DirectInbox>();
    subscription_ = inbox_->subscribe<nav_msgs::Odometry>(
        node, "odometry", 1, [this](Span<const std::uint8_t> bytes) { on_bytes(bytes); });
    return;
  }
  auto options = object_subscription<nav_msgs::Odometry>(
      "odometry", 1, [this](Span<const std::uint8_t> bytes) { on_bytes(bytes); },
      [this](const auto& message) { handler_(to_stamped_odometry(*message)); }, &queue_);
  subscriber_ = node.subscribe(options);
}

OdometryInput::~OdometryInput() {
  subscription_.reset();
  subscriber_.shutdown();
}

void OdometryInput::spin_once(std::chrono::milliseconds limit) {
  if (inbox_->wait(limit)) inbox_->read();
}

void OdometryInput::on_bytes(Span<const std::uint8_t> bytes) {
  const auto odometry = parse_odometry(bytes);
  if (!odometry) {
    ROS_ERROR_THROTTLE(5.0, "odometry of %zu bytes is too short to be a nav_msgs/Odometry; ignored",
                       bytes.size());
    return;
  }
  // A process of its own does not listen to /clock; a nodelet manager does.
  if (inbox_) set_log_time(odometry->stamp);
  handler_(*odometry);
}

}  // namespace trident
