// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mavros_msgs/Mavlink.h>
#include <ros/ros.h>

#include <memory>

#include "core/vehicle_side.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_bridges_ros/node_publisher.h"

namespace trident::mavros {

/// A packet as a message of ROS.
mavros_msgs::Mavlink to_ros(const Packet& packet);
/// The packet that a message of ROS is; empty: its fields are no packet.
std::vector<std::uint8_t> to_packet(const mavros_msgs::Mavlink& message);

/// The topics mavlink/from and mavlink/to of the node's namespace: all packets that concern this
/// node, and packets of other programs for the vehicle.
class PacketTopics {
 public:
  /// `vehicle` and `loop` must outlive it.
  PacketTopics(const ros::NodeHandle& node, VehicleSide& vehicle, bridges::NodePollLoop& loop);

 private:
  ros::NodeHandle node_;
  bridges::NodePublisher<mavros_msgs::Mavlink> from_;
  std::unique_ptr<ros_utils::DirectSubscription> to_;
};

}  // namespace trident::mavros
