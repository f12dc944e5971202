// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/pose_publisher.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include <array>
#include <cmath>

#include "trident_maps_ros/map_messages.h"

namespace trident::slam {

PosePublisher::PosePublisher(ros::NodeHandle node, ros::NodeHandle own,
                             const SlamNodeOptions& options)
    : frame_(options.map_frame),
      linear_scale_(std::sqrt(options.position_covariance_scale)),
      yaw_scale_(std::sqrt(options.yaw_covariance_scale)) {
  using Message = geometry_msgs::PoseWithCovarianceStamped;
  publishers_.push_back(node.advertise<Message>(options.pose_topic, 10));
  if (own.getNamespace() == node.getNamespace()) return;
  publishers_.push_back(own.advertise<Message>(options.pose_topic, 10));
}

void PosePublisher::publish(const ScanRecord& record, const ScanPose2d& pose) const {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header.stamp.fromNSec(static_cast<std::uint64_t>(record.scan.stamp_ns));
  message.header.frame_id = frame_;
  message.pose.pose = maps::to_pose_message(pose.T_map_base);
  constexpr std::array<std::size_t, 3> kPlanar = {0, 1, 5};  // x, y, yaw among six
  const std::array<double, 3> scale = {linear_scale_, linear_scale_, yaw_scale_};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      message.pose.covariance[6 * kPlanar[row] + kPlanar[column]] =
          scale[row] * scale[column] *
          pose.covariance(static_cast<int>(row), static_cast<int>(column));
    }
  }
  for (const ros::Publisher& publisher : publishers_) publisher.publish(message);
}

}  // namespace trident::slam
