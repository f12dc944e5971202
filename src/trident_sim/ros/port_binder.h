// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "trident_sim/port.h"

namespace trident {

/// An output port and its topic.
class OutputBinding {
 public:
  explicit OutputBinding(PortBase& port) : port_(&port), seen_(port.count()) {}
  virtual ~OutputBinding() = default;
  OutputBinding(const OutputBinding&) = delete;
  OutputBinding& operator=(const OutputBinding&) = delete;

  /// Converts the present value and publishes it.
  virtual void publish() = 0;
  /// Converts the present value to the bytes that go over the wire, length first.
  virtual ros::SerializedMessage serialize() = 0;
  virtual std::uint32_t subscribers() const = 0;
  virtual const ros::Publisher& publisher() const = 0;

  PortBase& port() const { return *port_; }
  /// Tells the port whether anybody listens.
  void set_wanted(bool wanted);
  bool wanted() const { return wanted_; }
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

/// Keeps one topic per output port of a board, and the frame tree on /tf.
class PortBinder {
 public:
  PortBinder(ros::NodeHandle& node, PortBoard& board);

  /// Follows ports that came or went; to be called whenever models did.
  void sync();
  /// Finds out which topics have subscribers.
  void scan_subscribers();
  /// Publishes what is new, in the order of the ports' ranks, except the bindings held back.
  void publish_fresh();
  /// Bindings of odometry in a namespace ("UAV1/"), which the lockstep sends itself.
  std::vector<OutputBinding*> hold_back_odometry(const std::string& prefix);

 private:
  struct Entry {
    std::unique_ptr<OutputBinding> binding;
    bool held_back = false;
  };
  void rebuild_active();

  ros::NodeHandle& node_;
  PortBoard& board_;
  std::uint64_t version_ = 0;
  std::map<std::string, Entry> entries_;
  std::vector<OutputBinding*> active_;  ///< wanted, not held back, by rank
  ros::Publisher tf_;
  tf2_msgs::TFMessage tf_message_;
};

}  // namespace trident
