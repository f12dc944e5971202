// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PoseWithCovariance.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include "trident_estimation/amcl.h"
#include "trident_estimation_ros/amcl_node_params.h"

namespace trident::estimation {

/// The covariance of (x [m], y [m], yaw [rad]) among the six of a message.
Eigen::Matrix3d planar_covariance(const geometry_msgs::PoseWithCovariance& pose);

/// Publishes `amcl_pose`, `particlecloud` and the transform global -> odom.
class AmclOutput {
 public:
  /// `params` must outlive it.
  AmclOutput(ros::NodeHandle& node, const AmclNodeParams& params);

  /// The estimate at a scan's stamp.
  void publish_pose(const ros::Time& stamp, const PoseEstimate& estimate);
  /// The particles, at most at `gui_publish_rate`.
  void publish_particles(const ros::Time& stamp, const Amcl& filter);
  /// Stamped `transform_tolerance` ahead, so that a look-up of the robot's pose now need not wait
  /// for the next scan.
  void publish_transform(const ros::Time& stamp, const SE2& T_global_odom);

 private:
  const AmclNodeParams& params_;
  ros::Publisher pose_, cloud_;
  ros::Time last_cloud_;
  tf2_ros::TransformBroadcaster broadcaster_;
};

}  // namespace trident::estimation
