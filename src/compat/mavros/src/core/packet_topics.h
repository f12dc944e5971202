// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mavros_msgs/Mavlink.h>
#include <ros/ros.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "core/vehicle_side.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_bridges_ros/node_publisher.h"

namespace trident::mavros {

/// Writes a packet into a message of ROS, whose memory it uses again.
void to_ros(const Packet& packet, mavros_msgs::Mavlink& message);
/// Writes the packet that a message of ROS is; empty: its fields are no packet.
void to_packet(const mavros_msgs::Mavlink& message, std::vector<std::uint8_t>& packet);

/// The topics mavlink/from and mavlink/to of the node's namespace: all packets that concern this
/// node, and packets of other programs for the vehicle.
class PacketTopics {
 public:
  /// `vehicle` and `loop` must outlive it.
  PacketTopics(const ros::NodeHandle& node, VehicleSide& vehicle, bridges::NodePollLoop& loop);

 private:
  ros::NodeHandle node_;
  bridges::NodePublisher<mavros_msgs::Mavlink> from_;
  mavros_msgs::Mavlink heard_;
  std::vector<std::uint8_t> asked_;  // a packet that another program sends
  std::unique_ptr<ros_utils::DirectSubscription> to_;
};

}  // namespace trident::mavros
