// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/transform_publisher.h"

#include "trident_maps_ros/map_messages.h"

namespace trident::slam {

TransformPublisher::TransformPublisher(ros::NodeHandle node, const SlamNodeOptions& options)
    : is_on_(options.transform_publish_period > 0.0),
      parent_frame_(options.map_frame),
      child_frame_(options.odom_frame.empty() ? options.base_frame : options.odom_frame),
      lead_(options.tf_delay < 0.0 ? options.transform_timeout : options.tf_delay) {
  if (!is_on_) return;
  timer_ = node.createTimer(ros::Duration(options.transform_publish_period),
                            [this](const ros::TimerEvent&) { publish(); });
}

void TransformPublisher::set(const SE2& T_map_odom) {
  {
    const Lock lock(mutex_);
    T_map_odom_ = T_map_odom;
  }
  publish();
}

void TransformPublisher::forget() {
  const Lock lock(mutex_);
  T_map_odom_.reset();
}

void TransformPublisher::publish() {
  if (!is_on_) return;
  geometry_msgs::TransformStamped message;
  {
    const Lock lock(mutex_);
    message.header.stamp = ros::Time::now() + lead_;
    // The same stamp twice would be ignored by every listener, with a warning.
    if (!T_map_odom_ || message.header.stamp == last_stamp_) return;
    last_stamp_ = message.header.stamp;
    const geometry_msgs::Pose pose = maps::to_pose_message(*T_map_odom_);
    message.transform.translation.x = pose.position.x;
    message.transform.translation.y = pose.position.y;
    message.transform.rotation = pose.orientation;
  }
  message.header.frame_id = parent_frame_;
  message.child_frame_id = child_frame_;
  broadcaster_.sendTransform(message);
}

}  // namespace trident::slam
