// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/topic_peers.h"

#include <ros/publisher_link.h>

#include "roscpp_internals.h"

namespace trident::ros_utils {

std::vector<TopicPeer> topic_readers(const std::string& topic) {
  const ros::PublicationPtr publication = ros::TopicManager::instance()->lookupPublication(topic);
  std::vector<TopicPeer> result;
  if (!publication) return result;
  boost::mutex::scoped_lock lock((*publication).*pointer_to(SubscriberLinksMutex{}));
  for (const ros::SubscriberLinkPtr& link : (*publication).*pointer_to(SubscriberLinks{})) {
    result.push_back({static_cast<int>(link->getConnectionID()), link->getDestinationCallerID()});
  }
  return result;
}

std::vector<std::string> topic_writers(const std::string& topic) {
  std::vector<std::string> result;
  ros::TopicManager& manager = *ros::TopicManager::instance();
  boost::mutex::scoped_lock lock(manager.*pointer_to(SubscriptionsMutex{}));
  for (const ros::SubscriptionPtr& subscription : manager.*pointer_to(Subscriptions{})) {
    if (subscription->getName() != topic) continue;
    boost::mutex::scoped_lock links((*subscription).*pointer_to(PublisherLinksMutex{}));
    for (const ros::PublisherLinkPtr& link : (*subscription).*pointer_to(PublisherLinks{})) {
      // Without a name the handshake has only begun.
      if (!link->getCallerID().empty()) result.push_back(link->getCallerID());
    }
  }
  return result;
}

}  // namespace trident::ros_utils
