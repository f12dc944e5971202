// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Geometry>

#include "core/conversions.h"
#include "core/mavros_params.h"
#include "core/ros_side.h"

namespace trident::mavros {

/// Sends one transform on /tf, where its parameters ask for that.
class TransformOutput {
 public:
  /// Advertises /tf if the transform is to be sent.
  TransformOutput(const RosSide& /*ros*/, const TfParams& params) : params_(params) {
    if (!params_.send) return;
    constexpr std::uint32_t kQueue = 100;
    publisher_ = ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf", kQueue);
  }

  /// Sends the pose of the child frame in the parent frame, each stamp once.
  void send(const ros::Time& stamp, const Eigen::Vector3d& p_m, const Eigen::Quaterniond& q) {
    if (!params_.send || stamp == newest_) return;
    newest_ = stamp;
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    auto& one = message.transforms.front();
    one.header.stamp = stamp;
    one.header.frame_id = params_.frame_id;
    one.child_frame_id = params_.child_frame_id;
    assign(one.transform.translation, p_m);
    assign_rotation(one.transform.rotation, q);
    publisher_.publish(message);
  }

 private:
  TfParams params_;
  ros::Publisher publisher_;
  ros::Time newest_;
};

}  // namespace trident::mavros
