// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <optional>
#include <string>

#include "trident_base/mutex.h"
#include "trident_base/se2.h"
#include "trident_slam_ros/slam_node_options.h"

namespace trident::slam {

/// Publishes map -> odom, or map -> base where there is no odometry: when it changes, and every
/// `transform_publish_period` with a new stamp. Does nothing when that is 0.
class TransformPublisher {
 public:
  /// Publishes nothing before the first set().
  TransformPublisher(ros::NodeHandle node, const SlamNodeOptions& options);

  /// Publishes a new correction of odometry at once. Callable from any thread.
  void set(const SE2& T_map_odom);
  /// The correction is not known until the next set(); nothing is published meanwhile.
  void forget();

 private:
  void publish();

  bool is_on_;
  std::string parent_frame_, child_frame_;
  ros::Duration lead_;  ///< By which stamps are ahead of now.
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Timer timer_;
  Mutex mutex_;
  std::optional<SE2> T_map_odom_ TRIDENT_GUARDED_BY(mutex_);
  ros::Time last_stamp_ TRIDENT_GUARDED_BY(mutex_);
};

}  // namespace trident::slam
