// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <map>
#include <memory>
#include <string>

#include "trident_ros/inline_callback_queue.h"
#include "trident_sim/port.h"

namespace trident {

/// An input port and its topic or service.
class InputBinding {
 public:
  virtual ~InputBinding() = default;
  virtual PortBase& port() const = 0;
  /// Hands the newest message that came since the last call to the port.
  virtual void deliver() = 0;
  virtual void forget() = 0;
};

/// Keeps a subscription per input of a board that ROS can serve (velocities, numbers, poses, paths,
/// triggers, texts), and a service per request. A message waits, the newest in place of those before
/// but for texts, until the stepping thread hands it to the port.
class InputBinder {
 public:
  InputBinder(ros::NodeHandle& node, PortBoard& board) : node_(node), board_(board) {}

  /// Follows ports that came or went; to be called whenever models did.
  void sync();
  /// Hands over what came since the last call. By the stepping thread, before a step.
  void deliver();
  /// Forgets what came; for a reset.
  void clear();

 private:
  ros::NodeHandle& node_;
  PortBoard& board_;
  std::uint64_t version_ = 0;
  InlineCallbackQueue queue_;
  std::map<std::string, std::unique_ptr<InputBinding>> entries_;
};

}  // namespace trident
