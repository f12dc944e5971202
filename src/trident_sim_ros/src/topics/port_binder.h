// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "trident_sim/port.h"
#include "trident_sim_ros/output_topic.h"

namespace trident::sim {

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
  /// nullptr: the port has no topic of its name. Valid until the next sync().
  OutputBinding* find(const std::string& port) const;
  /// As find(); the port is wanted from now on.
  OutputBinding* tap(const std::string& port);
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
  static void publish_if_fresh(OutputBinding& binding, bool is_display_due);

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
