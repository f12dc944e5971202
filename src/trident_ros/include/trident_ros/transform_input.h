// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace trident::ros_utils {

/// Hands transforms to a buffer, except those that would harm it: numbers that are not finite, and
/// wrong stamps. A buffer keeps what is newer than its newest transform less its length: a
/// single one stamped far ahead would make it refuse all that follow. No clock, no threads.
class TransformGate {
 public:
  /// `buffer` must outlive it; nothing else may write to it.
  explicit TransformGate(tf2::BufferCore& buffer) : buffer_(buffer) {}

  /// Empty, or why the transform is refused. `now`: of the clock; zero: not known yet.
  std::string add(const geometry_msgs::TransformStamped& transform, const std::string& authority,
                  bool is_static, const ros::Time& now);
  /// Forgets all transforms but static ones.
  void clear();

  /// So many transforms of a child in a row that are older than what is kept are the right ones:
  /// the newest was not.
  static constexpr int kPatience = 20;

 private:
  struct Child {
    ros::Time newest;
    int behind = 0;  ///< transforms in a row that were too old
  };

  bool is_too_old(const geometry_msgs::TransformStamped& transform);

  tf2::BufferCore& buffer_;
  std::map<std::string, Child> children_;
};

/// /tf and /tf_static into a buffer through a gate, in a thread of its own; in place of
/// tf2_ros::TransformListener. When ROS time goes back, transforms are forgotten.
class TransformInput {
 public:
  /// Called for each refused transform, in the thread of this object.
  using OnRefusal = std::function<void(const std::string& problem)>;

  /// Subscribes at once. `buffer` must outlive it; `on_refusal` must be safe in another thread.
  TransformInput(tf2::BufferCore& buffer, OnRefusal on_refusal);
  ~TransformInput();
  TransformInput(const TransformInput&) = delete;
  TransformInput& operator=(const TransformInput&) = delete;

  /// Forgets all transforms but static ones.
  void clear();

 private:
  using Event = ros::MessageEvent<tf2_msgs::TFMessage const>;
  void receive(const Event& event, bool is_static);

  std::mutex mutex_;  // guards the gate
  TransformGate gate_;
  OnRefusal on_refusal_;
  ros::Time last_update_;
  ros::CallbackQueue queue_;
  ros::Subscriber changing_, static_;
  ros::AsyncSpinner spinner_{1, &queue_};
};

}  // namespace trident::ros_utils
