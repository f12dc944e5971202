// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/amcl_output.h"

#include <geometry_msgs/PoseArray.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include "trident_maps_ros/map_messages.h"

namespace trident::estimation {
namespace {

/// Index in a 6 x 6 covariance of the planar entry (row, column), each of x, y, yaw. ROS orders x,
/// y, z, roll, pitch, yaw.
std::size_t planar_index(int row, int column) {
  constexpr int kRow[] = {0, 1, 5};
  return static_cast<std::size_t>(6 * kRow[row] + kRow[column]);
}

}  // namespace

Eigen::Matrix3d planar_covariance(const geometry_msgs::PoseWithCovariance& pose) {
  Eigen::Matrix3d covariance;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      covariance(row, column) = pose.covariance[planar_index(row, column)];
    }
  }
  return covariance;
}

AmclOutput::AmclOutput(ros::NodeHandle& node, const AmclNodeParams& params) : params_(params) {
  pose_ = node.advertise<geometry_msgs::PoseWithCovarianceStamped>("amcl_pose", 2, true);
  cloud_ = node.advertise<geometry_msgs::PoseArray>("particlecloud", 2, true);
}

void AmclOutput::publish_pose(const ros::Time& stamp, const PoseEstimate& estimate) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header.frame_id = params_.global_frame_id;
  message.header.stamp = stamp;
  message.pose.pose = maps::to_pose_message(estimate.T_map_base);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      message.pose.covariance[planar_index(row, column)] = estimate.covariance(row, column);
    }
  }
  pose_.publish(message);
}

void AmclOutput::publish_particles(const ros::Time& stamp, const Amcl& filter) {
  const bool is_due = params_.gui_publish_rate <= 0.0 || stamp < last_cloud_ ||
                      (stamp - last_cloud_).toSec() >= 1.0 / params_.gui_publish_rate;
  if (!is_due) return;
  last_cloud_ = stamp;
  geometry_msgs::PoseArray message;
  message.header.frame_id = params_.global_frame_id;
  message.header.stamp = stamp;
  message.poses.reserve(filter.particle_count());
  for (std::size_t i = 0; i < filter.particle_count(); ++i) {
    message.poses.push_back(maps::to_pose_message(filter.particle(i)));
  }
  cloud_.publish(message);
}

void AmclOutput::publish_transform(const ros::Time& stamp, const SE2& T_global_odom) {
  if (!params_.tf_broadcast) return;
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = params_.global_frame_id;
  transform.header.stamp = stamp + ros::Duration(params_.transform_tolerance);
  transform.child_frame_id = params_.odom_frame_id;
  const geometry_msgs::Pose pose = maps::to_pose_message(T_global_odom);
  transform.transform.translation.x = pose.position.x;
  transform.transform.translation.y = pose.position.y;
  transform.transform.rotation = pose.orientation;
  broadcaster_.sendTransform(transform);
}

}  // namespace trident::estimation
