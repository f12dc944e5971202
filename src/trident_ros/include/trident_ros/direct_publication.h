// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/forwards.h>
#include <ros/publisher.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "trident_base/span.h"
#include "trident_ros/direct_message.h"

namespace trident::ros_utils {

/// Sends messages of an advertised topic straight into its sockets, from the caller's thread.
/// ros::Publisher queues a message, wakes the socket thread through a pipe and arms and disarms the
/// socket for writing: eleven system calls more than the one that sends. A link that is still
/// shaking hands or has unsent bytes gets the message through roscpp's own queue, so order and
/// framing hold. Subscribers in this process get the object, or the bytes if they ask for another
/// type, before send() returns. Nothing else may publish on the topic, and calls must not overlap.
class DirectPublication {
 public:
  /// `publisher` has advertised the topic, and must not publish on it itself from now on.
  explicit DirectPublication(const ros::Publisher& publisher);

  /// Number to put into the next message's header.seq.
  std::uint32_t next_sequence();

  /// Only to connections that are newer than `after`, 0: to all; see TopicPeer. Returns the newest
  /// that there is.
  int send(DirectMessage& message, int after = 0);
  /// The same for a message that there is as bytes only, with the 4-byte length before it.
  void send(Span<const std::uint8_t> frame);

  /// ros::Publisher::getNumSubscribers() without its search by name.
  std::uint32_t subscribers() const;

 private:
  void take_links();
  void write(ros::SubscriberLink& link, Span<const std::uint8_t> frame);
  void hand_over(ros::SubscriberLink& link, DirectMessage& message, std::uint32_t sequence);

  ros::PublicationPtr publication_;
  std::vector<ros::SubscriberLinkPtr> links_;  // reused by send(), empty between calls
};

}  // namespace trident::ros_utils
