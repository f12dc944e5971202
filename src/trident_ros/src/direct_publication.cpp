// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/direct_publication.h"

#include <ros/connection.h>
#include <ros/publication.h>
#include <ros/subscriber_link.h>
#include <ros/topic_manager.h>
#include <ros/transport/transport_tcp.h>
#include <ros/transport_subscriber_link.h>

#include <cstring>

namespace trident {
namespace {

// roscpp has no accessor for these four members. An explicit instantiation may name private
// members, and hands out pointers to them; the layout is the one of the installed headers, as for
// any inline function.
template <typename Tag, typename Tag::Member member>
struct Reveal {
  friend typename Tag::Member pointer_to(Tag) { return member; }
};

#define TRIDENT_REVEAL(name, owner, type, field) \
  struct name {                                  \
    using Member = type owner::*;                \
    friend Member pointer_to(name);              \
  };                                             \
  template struct Reveal<name, &owner::field>

TRIDENT_REVEAL(SubscriberLinks, ros::Publication, ros::V_SubscriberLink, subscriber_links_);
TRIDENT_REVEAL(SubscriberLinksMutex, ros::Publication, boost::mutex, subscriber_links_mutex_);
TRIDENT_REVEAL(HeaderWritten, ros::TransportSubscriberLink, bool, header_written_);
TRIDENT_REVEAL(WritingMessage, ros::TransportSubscriberLink, bool, writing_message_);

#undef TRIDENT_REVEAL

ros::SerializedMessage copy_of(Span<const std::uint8_t> bytes) {
  boost::shared_array<std::uint8_t> buffer(new std::uint8_t[bytes.size()]);
  std::memcpy(buffer.get(), bytes.data(), bytes.size());
  return {buffer, bytes.size()};
}

// The transport of a link that has nothing queued and could take bytes now, or null.
ros::TransportTCP* idle_transport(ros::SubscriberLink& link) {
  auto* const tcp_link = dynamic_cast<ros::TransportSubscriberLink*>(&link);
  if (!tcp_link) return nullptr;
  const bool is_idle =
      tcp_link->*pointer_to(HeaderWritten{}) && !(tcp_link->*pointer_to(WritingMessage{}));
  if (!is_idle) return nullptr;
  return dynamic_cast<ros::TransportTCP*>(tcp_link->getConnection()->getTransport().get());
}

}  // namespace

DirectPublication::DirectPublication(const ros::Publisher& publisher)
    : publication_(ros::TopicManager::instance()->lookupPublication(publisher.getTopic())) {}

std::uint32_t DirectPublication::next_sequence() { return publication_->incrementSequence(); }

void DirectPublication::send(Span<const std::uint8_t> frame) {
  {
    boost::mutex::scoped_lock lock((*publication_).*pointer_to(SubscriberLinksMutex{}));
    links_ = (*publication_).*pointer_to(SubscriberLinks{});
  }
  // Without the lock: a failing write drops its link, and that takes the lock.
  for (const ros::SubscriberLinkPtr& link : links_) send_to(*link, frame);
  links_.clear();
}

void DirectPublication::send_to(ros::SubscriberLink& link, Span<const std::uint8_t> frame) {
  std::size_t sent = 0;
  if (ros::TransportTCP* const transport = idle_transport(link)) {
    const std::int32_t written = transport->write(const_cast<std::uint8_t*>(frame.data()),
                                                  static_cast<std::uint32_t>(frame.size()));
    if (written < 0) return;  // closed; roscpp has dropped the link
    sent = static_cast<std::size_t>(written);
  }
  if (sent < frame.size()) link.enqueueMessage(copy_of(frame.subspan(sent)), true, false);
}

}  // namespace trident
