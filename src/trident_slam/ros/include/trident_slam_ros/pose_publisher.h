// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include "trident_slam/scan_source.h"
#include "trident_slam/slam_2d.h"
#include "trident_slam_ros/slam_node_options.h"

namespace trident::slam {

/// Publishes the pose of each scan with its covariance, on `pose_topic` both in the namespace of
/// the node and in its private one.
class PosePublisher {
 public:
  /// Advertises in both namespaces: that of `node` and `own`, the private one.
  PosePublisher(ros::NodeHandle node, ros::NodeHandle own, const SlamNodeOptions& options);

  /// The pose that a scan led to.
  void publish(const ScanRecord& record, const ScanPose2d& pose) const;

 private:
  std::string frame_;
  double linear_scale_, yaw_scale_;  ///< Of standard deviations.
  std::vector<ros::Publisher> publishers_;
};

}  // namespace trident::slam
