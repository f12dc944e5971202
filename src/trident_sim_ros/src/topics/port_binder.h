// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "trident_ros/direct_message.h"
#include "trident_ros/inline_callback_queue.h"
#include "trident_sim/port.h"

namespace trident::sim {

/// An output port and its topic.
class OutputBinding {
 public:
  explicit OutputBinding(PortBase& port) : port_(&port), seen_(port.count()) {}
  virtual ~OutputBinding() = default;
  OutputBinding(const OutputBinding&) = delete;
  OutputBinding& operator=(const OutputBinding&) = delete;

  /// Converts the present value and publishes it.
  virtual void publish() = 0;
  /// Converts the present value into a message that may wait to be sent; nullptr when the topic
  /// takes no single messages.
  virtual std::unique_ptr<ros_utils::DirectMessage> message() = 0;
  virtual std::uint32_t subscribers() const = 0;
  virtual const ros::Publisher& publisher() const = 0;
  /// Joint states: of use to displays only.
  virtual bool is_for_display() const { return false; }
  /// Who subscribes later gets the newest value, so that every value is sent.
  virtual bool is_latched() const { return false; }

  PortBase& port() const { return *port_; }
  /// Sets whether the port has a listener.
  void set_wanted(bool wanted);
  bool wanted() const { return wanted_; }
  bool is_late = false;  ///< a value was not published yet, for the wall rate of displays
  /// True once per new value.
  bool take_fresh() {
    if (port_->count() == seen_) return false;
    seen_ = port_->count();
    return true;
  }

 private:
  PortBase* port_;
  std::uint64_t seen_;
  bool wanted_ = false;
};

/// Advertises topics and notes when a subscriber comes or goes.
class TopicAdvertiser {
 public:
  explicit TopicAdvertiser(ros::NodeHandle& node) : node_(node) {}

  template <class Message>
  ros::Publisher advertise(const std::string& topic, std::uint32_t queue_size,
                           bool is_latched = false) {
    const auto note = [this](const ros::SingleSubscriberPublisher&) { has_changed_ = true; };
    ros::AdvertiseOptions options;
    options.init<Message>(topic, queue_size, note, note);
    options.callback_queue = &queue_;
    options.latch = is_latched;
    has_changed_ = true;
    return node_.advertise(options);
  }
  /// True once after a change.
  bool take_change() { return has_changed_.exchange(false); }

 private:
  ros::NodeHandle& node_;
  ros_utils::InlineCallbackQueue queue_;
  std::atomic<bool> has_changed_{true};
};

/// Keeps one topic per output port of a board, of images a compressed one too, and the frame tree
/// on /tf.
class PortBinder {
 public:
  PortBinder(ros::NodeHandle& node, PortBoard& board);

  /// Follows ports that came or went; to be called whenever models did.
  void sync();
  /// Sends what the wall rate of displays held back; for when the world comes to stand.
  void publish_held_display();
  /// Finds out which topics have subscribers, if any came or went since the last call.
  void scan_subscribers();
  /// Publishes what is new among the ports of these ranks, in their order, except what is held
  /// back. Unless `every_step`, joint states, which only displays need, keep to a wall rate: each
  /// one makes a robot_state_publisher ask the master for its tf_prefix.
  void publish_fresh(PortRank first, PortRank last, bool every_step);
  /// How many read the topic of a port; 0 where there is no such port.
  std::uint32_t subscribers(const std::string& port) const;
  /// Bindings of odometry in a namespace ("UAV1/"), which the lockstep sends itself.
  std::vector<OutputBinding*> hold_back_odometry(const std::string& prefix);

 private:
  struct Entry {
    std::string port;  ///< its name; several topics may share one
    std::unique_ptr<OutputBinding> binding;
    bool held_back = false;
  };
  static bool is_needed(const Entry& entry);
  void forget_gone_ports();
  std::unique_ptr<OutputBinding> bind(PortBase& port);
  void rebuild_active();
  void send_frames();
  bool display_is_due(bool every_step);

  PortBoard& board_;
  TopicAdvertiser advertiser_;
  std::uint64_t version_ = 0;
  std::map<std::string, Entry> entries_;  ///< by topic
  std::vector<OutputBinding*> active_;    ///< wanted, not held back, by rank
  ros::Publisher tf_;
  tf2_msgs::TFMessage tf_message_;
  std::chrono::steady_clock::time_point last_display_;
};

}  // namespace trident::sim
