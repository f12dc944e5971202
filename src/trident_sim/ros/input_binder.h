// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Twist.h>
#include <ros/ros.h>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "trident_ros/inline_callback_queue.h"
#include "trident_sim/port.h"
#include "trident_sim/samples.h"

namespace trident {

/// Keeps a subscription per velocity input of a board. A message waits, the newest in place of
/// those before, until the stepping thread hands it to the port.
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
  class Mailbox {
   public:
    void put(const geometry_msgs::Twist& message);
    std::optional<TwistCommand> take();

   private:
    std::mutex mutex_;
    std::optional<TwistCommand> newest_;
  };
  struct Entry {
    InPort<TwistCommand>* port;
    std::shared_ptr<Mailbox> mailbox;  ///< outlives a message that is under way
    ros::Subscriber subscriber;
  };

  ros::NodeHandle& node_;
  PortBoard& board_;
  std::uint64_t version_ = 0;
  InlineCallbackQueue queue_;
  std::map<std::string, Entry> entries_;
};

}  // namespace trident
