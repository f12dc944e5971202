// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/connection.h>
#include <ros/publication.h>
#include <ros/publisher_link.h>
#include <ros/subscriber_link.h>
#include <ros/subscription.h>
#include <ros/topic_manager.h>
#include <ros/transport/transport_tcp.h>
#include <ros/transport_subscriber_link.h>

namespace trident::ros_utils {

// roscpp has no accessor for these members. An explicit instantiation may name private members, and
// hands out pointers to them; the layout is the one of the installed headers, as for any inline
// function.
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
TRIDENT_REVEAL(Outbox, ros::TransportSubscriberLink, std::queue<ros::SerializedMessage>, outbox_);
TRIDENT_REVEAL(OutboxMutex, ros::TransportSubscriberLink, boost::mutex, outbox_mutex_);
TRIDENT_REVEAL(Subscriptions, ros::TopicManager, ros::L_Subscription, subscriptions_);
TRIDENT_REVEAL(SubscriptionsMutex, ros::TopicManager, boost::mutex, subs_mutex_);
TRIDENT_REVEAL(PublisherLinks, ros::Subscription, std::vector<ros::PublisherLinkPtr>,
               publisher_links_);
TRIDENT_REVEAL(PublisherLinksMutex, ros::Subscription, boost::mutex, publisher_links_mutex_);
TRIDENT_REVEAL(PublisherHeader, ros::PublisherLink, ros::Header, header_);
TRIDENT_REVEAL(ReadFilled, ros::Connection, std::uint32_t, read_filled_);
TRIDENT_REVEAL(ReadSize, ros::Connection, std::uint32_t, read_size_);
TRIDENT_REVEAL(HasReadCallback, ros::Connection, volatile std::uint32_t, has_read_callback_);
TRIDENT_REVEAL(Socket, ros::TransportTCP, ros::socket_fd_t, sock_);
TRIDENT_REVEAL(SocketClosed, ros::TransportTCP, bool, closed_);
TRIDENT_REVEAL(CloseMutex, ros::TransportTCP, boost::recursive_mutex, close_mutex_);

#undef TRIDENT_REVEAL

}  // namespace trident::ros_utils
