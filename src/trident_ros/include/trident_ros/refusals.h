// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/this_node.h>
#include <ros/wall_timer.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace trident::ros_utils {

/// Messages that a node refuses, by kind: each kind is logged at once and then every few seconds
/// at most, and counted in /diagnostics, where the node has a status "`node`: kind" of
/// each. From any thread.
class Refusals {
 public:
  /// Advertises /diagnostics. `owner`: absolute name that is shown in place of the node's, as of a
  /// part that could be a node of its own.
  explicit Refusals(ros::NodeHandle& node, const std::string& owner = ros::this_node::getName());

  /// Counts a refusal and logs it if its kind is due. `text`: what was refused and why.
  void note(const std::string& kind, const std::string& text);
  /// Counts it without logging it: the node has its own sentence for the log.
  void count(const std::string& kind, const std::string& text);

 private:
  struct Kind {
    std::string newest;
    std::uint64_t count = 0, logged = 0;
    ros::WallTime logged_at;
  };
  Kind& counted(const std::string& kind, const std::string& text);
  /// Publishes what is due, without the mutex: roscpp may come with locks that publishing takes.
  void publish_if_due();
  std::optional<diagnostic_msgs::DiagnosticArray> due_news();

  const std::string owner_;   ///< without its first slash
  const std::string prefix_;  ///< of what is logged
  std::mutex mutex_;
  std::map<std::string, Kind> kinds_;
  ros::WallTime published_at_;
  bool has_news_ = false;  ///< that are not published
  ros::Publisher diagnostics_;
  ros::WallTimer timer_;
};

}  // namespace trident::ros_utils
