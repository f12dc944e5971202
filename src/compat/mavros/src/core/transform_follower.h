// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/tf_params.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_ros/refusals.h"
#include "trident_ros/transform_input.h"

namespace trident::mavros {

/// The pose of a child frame in its parent.
struct FollowedPose {
  ros::Time stamp;  ///< zero: of static transforms alone
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond R_parent_child = Eigen::Quaterniond::Identity();
};

/// Decides when a pose that is followed is due. No clock.
class FollowedRate {
 public:
  /// `rate_hz`: at most so many new poses.
  explicit FollowedRate(double rate_hz) : period_s_(1.0 / rate_hz) {}

  /// Whether a pose is the first, or a period after the one before; stamps that go back begin
  /// again.
  bool is_due(const ros::Time& stamp);

 private:
  double period_s_;
  std::optional<ros::Time> newest_;
};

/// /tf and /tf_static of a process, for all plugins that follow a transform. In the loop's thread.
class Transforms {
 public:
  /// Subscribes when the first transform is followed. `loop` must outlive it.
  explicit Transforms(bridges::NodePollLoop& loop) : loop_(loop) {}
  Transforms(const Transforms&) = delete;
  Transforms& operator=(const Transforms&) = delete;

  /// Calls `handler` after each message of /tf or /tf_static. `refusals` has what is refused of
  /// them, and must outlive the loop's run.
  void on_change(ros_utils::Refusals& refusals, std::function<void()> handler);
  /// The newest pose of the child in the frame; nullopt: they are not connected.
  std::optional<FollowedPose> find(const TfParams& params) const;

 private:
  void subscribe();
  void receive(const tf2_msgs::TFMessage& message, bool is_static);

  bridges::NodePollLoop& loop_;
  tf2::BufferCore buffer_;
  ros_utils::TransformGate gate_{buffer_};
  ros::Time last_;
  ros_utils::Refusals* refusals_ = nullptr;
  std::vector<std::function<void()>> handlers_;
  std::unique_ptr<ros_utils::DirectSubscription> changing_, static_;
};

}  // namespace trident::mavros
