// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/direct_publication.h"

#include <sys/socket.h>

#include <algorithm>
#include <cstring>

#include "roscpp_internals.h"
#include "trident_ros/schedule_fuzz.h"

namespace trident::ros_utils {
namespace {

ros::SerializedMessage copy_of(Span<const std::uint8_t> bytes) {
  boost::shared_array<std::uint8_t> buffer(new std::uint8_t[bytes.size()]);
  std::memcpy(buffer.get(), bytes.data(), bytes.size());
  return {buffer, bytes.size()};
}

// A frame of which a subscriber in this process sees what is behind the length.
ros::SerializedMessage unframed_copy_of(Span<const std::uint8_t> frame) {
  ros::SerializedMessage copy = copy_of(frame);
  copy.message_start = copy.buf.get() + sizeof(std::uint32_t);
  return copy;
}

// The transport of a link that has nothing queued and could take bytes now, or null.
ros::TransportTCP* idle_transport(ros::SubscriberLink& link) {
  auto* const tcp_link = dynamic_cast<ros::TransportSubscriberLink*>(&link);
  if (!tcp_link) return nullptr;
  boost::mutex::scoped_lock lock(tcp_link->*pointer_to(OutboxMutex{}));
  const bool is_idle = tcp_link->*pointer_to(HeaderWritten{}) &&
                       !(tcp_link->*pointer_to(WritingMessage{})) &&
                       (tcp_link->*pointer_to(Outbox{})).empty();
  if (!is_idle) return nullptr;
  return dynamic_cast<ros::TransportTCP*>(tcp_link->getConnection()->getTransport().get());
}

// Bytes that the socket took at once; 0 also when it is broken, which roscpp finds out itself.
std::size_t write_now(ros::TransportTCP& transport, Span<const std::uint8_t> bytes) {
  // The lock keeps the descriptor from being closed, and its number from being given away.
  boost::recursive_mutex::scoped_lock lock(transport.*pointer_to(CloseMutex{}));
  if (transport.*pointer_to(SocketClosed{})) return 0;
  const auto sent = ::send(transport.*pointer_to(Socket{}), bytes.data(), bytes.size(),
                           MSG_DONTWAIT | MSG_NOSIGNAL);
  return sent > 0 ? static_cast<std::size_t>(sent) : 0;
}

}  // namespace

DirectPublication::DirectPublication(const ros::Publisher& publisher)
    : publication_(ros::TopicManager::instance()->lookupPublication(publisher.getTopic())) {}

std::uint32_t DirectPublication::next_sequence() { return publication_->incrementSequence(); }

std::uint32_t DirectPublication::subscribers() const { return publication_->getNumSubscribers(); }

void DirectPublication::take_links() {
  boost::mutex::scoped_lock lock((*publication_).*pointer_to(SubscriberLinksMutex{}));
  links_ = (*publication_).*pointer_to(SubscriberLinks{});
}

// In all of these without the lock: a failing write drops its link, and that takes the lock.
int DirectPublication::send(DirectMessage& message, int after) {
  trident::ros_utils::hand_over("publication sends");
  take_links();
  const std::uint32_t sequence = next_sequence();
  int newest = 0;
  for (const ros::SubscriberLinkPtr& link : links_) {
    newest = std::max(newest, link->getConnectionID());
    // Connections are counted from zero, so that zero leaves nobody out.
    if (after > 0 && link->getConnectionID() <= after) continue;
    if (link->isIntraprocess()) {
      hand_over(*link, message, sequence);
    } else {
      write(*link, message.frame(sequence));
    }
  }
  links_.clear();
  return newest;
}

void DirectPublication::send(Span<const std::uint8_t> frame) {
  take_links();
  for (const ros::SubscriberLinkPtr& link : links_) {
    if (link->isIntraprocess()) {
      link->enqueueMessage(unframed_copy_of(frame), true, false);
    } else {
      write(*link, frame);
    }
  }
  links_.clear();
}

void DirectPublication::write(ros::SubscriberLink& link, Span<const std::uint8_t> frame) {
  std::size_t sent = 0;
  if (ros::TransportTCP* const transport = idle_transport(link)) {
    sent = write_now(*transport, frame);
  }
  if (sent < frame.size()) link.enqueueMessage(copy_of(frame.subspan(sent)), true, false);
}

void DirectPublication::hand_over(ros::SubscriberLink& link, DirectMessage& message,
                                  std::uint32_t sequence) {
  bool takes_bytes = false, takes_object = false;
  link.getPublishTypes(takes_bytes, takes_object, message.type());
  ros::SerializedMessage form;
  if (takes_bytes) form = unframed_copy_of(message.frame(sequence));
  if (takes_object) form.message = message.object();
  form.type_info = &message.type();  // also without an object: roscpp compares it to choose bytes
  if (takes_bytes || takes_object) link.enqueueMessage(form, takes_bytes, takes_object);
}

}  // namespace trident::ros_utils
