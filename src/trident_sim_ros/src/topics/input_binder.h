// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "run/repeatability.h"
#include "trident_ros/inline_callback_queue.h"
#include "trident_sim/port.h"
#include "trident_sim_ros/output_topic.h"

namespace trident::sim {

/// Rung when a message has come.
class MessageBell {
 public:
  void ring();
  /// Until the next message, or for `limit`; at once when one came since the last call.
  void wait(std::chrono::milliseconds limit);

 private:
  std::mutex mutex_;
  std::condition_variable rung_;
  bool has_rung_ = false;
};

/// An input port and its topic or service.
class InputBinding {
 public:
  virtual ~InputBinding() = default;
  virtual PortBase& port() const = 0;
  /// Hands the newest message that came since the last call to the port, at the beginning of a step
  /// at `begin`.
  virtual void deliver(SimTime begin) = 0;
  virtual void forget() = 0;
  /// How many messages have come in all.
  virtual std::uint64_t received() const = 0;
  virtual std::uint32_t publishers() const = 0;

  /// Of its messages, of an input of bytes as far as it is known; "" as name: it is not.
  virtual ros_utils::TopicType type() const { return {}; }

  virtual void hold() { is_held = true; }
  bool is_held = false;  ///< somebody else says when messages are handed over
};

/// Keeps a subscription per input of a board that ROS can serve (velocities, numbers, poses, paths,
/// triggers, texts, bytes), and a service per request. An input of bytes whose name an output has,
/// too, is not served: see RadioRelay. A message waits, the newest in place of those before but for
/// texts, packets and bytes, until the stepping thread hands it to the port.
class InputBinder {
 public:
  /// What comes while the world runs, and is not held, is noted in `repeatability`.
  InputBinder(ros::NodeHandle& node, PortBoard& board, Repeatability& repeatability)
      : node_(node), board_(board), repeatability_(repeatability) {}

  /// Follows ports that came or went; to be called whenever models did.
  void sync();
  /// Hands over what came since the last call. By the stepping thread, before a step.
  void deliver(SimTime begin);
  /// Forgets what came; for a reset.
  void clear();

  /// Messages of this input wait for deliver_held(). No such input: nothing happens.
  void hold(const std::string& port);
  void deliver_held(const std::string& port, SimTime begin);
  std::uint64_t received(const std::string& port) const;
  std::uint32_t publishers(const std::string& port) const;
  /// Sleeps until a message comes to any input, or for `limit`.
  void wait_for_message(std::chrono::milliseconds limit) { bell_->wait(limit); }
  /// nullptr: there is no such input, or ROS cannot serve it. Valid until the next sync().
  InputBinding* find(const std::string& port) const;

 private:
  ros::NodeHandle& node_;
  PortBoard& board_;
  Repeatability& repeatability_;
  std::uint64_t version_ = 0;
  void forget_gone_ports();
  std::unique_ptr<InputBinding> bind(PortBase& port);

  ros_utils::InlineCallbackQueue queue_;
  /// Outlives a message in progress.
  std::shared_ptr<MessageBell> bell_ = std::make_shared<MessageBell>();
  std::map<std::string, std::unique_ptr<InputBinding>> entries_;
};

}  // namespace trident::sim
