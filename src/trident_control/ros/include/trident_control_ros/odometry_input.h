// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <chrono>
#include <functional>
#include <memory>

#include "trident_control_ros/message_conversions.h"
#include "trident_ros/direct_inbox.h"
#include "trident_ros/inline_callback_queue.h"
#include "trident_ros/refusals.h"

namespace trident::control {

/// Whose thread handles odometry.
enum class OdometryThread {
  kCaller,    ///< that of spin_once(), which reads the sockets itself
  kPublisher  ///< in a nodelet manager: that of the publisher, which hands its object over; what
              ///< comes from other processes is handled by roscpp's socket thread
};

/// The topic `odometry` of a controller. Messages that are too short are refused.
class OdometryInput {
 public:
  using Handler = std::function<void(const StampedOdometry&)>;

  /// Subscribes at once; `handler` is called in the thread that `thread` names.
  OdometryInput(ros::NodeHandle& node, OdometryThread thread, Handler handler);
  /// No handler runs afterwards.
  ~OdometryInput();
  OdometryInput(const OdometryInput&) = delete;
  OdometryInput& operator=(const OdometryInput&) = delete;

  /// OdometryThread::kCaller only: handles what has come, or comes within `limit`.
  void spin_once(std::chrono::milliseconds limit);

 private:
  void on_bytes(Span<const std::uint8_t> bytes);
  void hand_over(const StampedOdometry& odometry);

  Handler handler_;
  ros_utils::Refusals refusals_;
  std::unique_ptr<ros_utils::DirectInbox> inbox_;  ///< OdometryThread::kCaller
  std::unique_ptr<ros_utils::DirectSubscription> subscription_;
  ros_utils::InlineCallbackQueue queue_;
  ros::Subscriber subscriber_;  ///< OdometryThread::kPublisher
};

}  // namespace trident::control
