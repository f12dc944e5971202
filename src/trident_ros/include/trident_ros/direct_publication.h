// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/forwards.h>
#include <ros/publisher.h>

#include <cstddef>
#include <cstdint>

#include "trident_base/span.h"

namespace trident {

/// Sends serialised messages of an advertised topic straight into its sockets, from the caller's
/// thread. ros::Publisher queues a message, wakes the socket thread through a pipe and arms and
/// disarms the socket for writing: eleven system calls more than the one that sends. A link that is
/// still shaking hands or has unsent bytes gets the message through roscpp's own queue, so order
/// and framing hold. The topic must be published in no other way, and calls must not overlap.
class DirectPublication {
 public:
  explicit DirectPublication(const ros::Publisher& publisher);

  /// Number to put into the next message's header.seq.
  std::uint32_t next_sequence();

  /// `frame`: a whole message with the 4-byte length that TCPROS puts before it.
  void send(Span<const std::uint8_t> frame);

  /// ros::Publisher::getNumSubscribers() without its search by name.
  std::uint32_t subscribers() const;

 private:
  void send_to(ros::SubscriberLink& link, Span<const std::uint8_t> frame);

  ros::PublicationPtr publication_;
  std::vector<ros::SubscriberLinkPtr> links_;  // reused by send(), empty between calls
};

}  // namespace trident
