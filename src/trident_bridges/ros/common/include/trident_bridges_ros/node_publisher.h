// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/message_traits.h>
#include <ros/node_handle.h>
#include <ros/serialization.h>

#include <cstring>
#include <string>
#include <vector>

#include "trident_ros/direct_publication.h"

namespace trident::bridges {

/// Publishes straight into the subscribers' sockets, from the thread that calls it, without taking
/// memory for a message. For frequent topics that are not latched.
template <class Message>
class NodePublisher {
 public:
  /// Advertises the topic; nothing else in the process may publish on it.
  NodePublisher(ros::NodeHandle& node, const std::string& topic, std::uint32_t queue_size = 100)
      : publisher_(node.advertise<Message>(topic, queue_size)), publication_(publisher_) {}

  /// Sends it now; what a subscriber does not take waits in a queue of roscpp. header.seq is
  /// counted here. Calls must not overlap.
  void publish(const Message& message) {
    const std::uint32_t sequence = publication_.next_sequence();
    if (publication_.subscribers() == 0) return;
    const std::uint32_t length = ros::serialization::serializationLength(message);
    frame_.resize(sizeof(length) + length);
    ros::serialization::OStream stream(frame_.data(), static_cast<std::uint32_t>(frame_.size()));
    ros::serialization::serialize(stream, length);
    ros::serialization::serialize(stream, message);
    if (ros::message_traits::hasHeader<Message>()) {
      std::memcpy(frame_.data() + sizeof(length), &sequence, sizeof(sequence));
    }
    publication_.send(Span<const std::uint8_t>(frame_));
  }

  /// Connected now; nothing needs to be computed for nobody.
  std::uint32_t subscribers() const { return publication_.subscribers(); }
  /// As it is advertised, with its namespace.
  std::string topic() const { return publisher_.getTopic(); }

 private:
  ros::Publisher publisher_;
  ros_utils::DirectPublication publication_;
  std::vector<std::uint8_t> frame_;  ///< the 4-byte length and the message
};

}  // namespace trident::bridges
