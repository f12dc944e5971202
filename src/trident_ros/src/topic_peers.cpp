// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/topic_peers.h"

#include <ros/master.h>
#include <ros/this_node.h>

#include "roscpp_internals.h"
#include "trident_base/string_util.h"

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

namespace {

/// Calls visit(PublisherLink&) for each publisher that this process has shaken hands with.
template <class Visitor>
void for_each_writer(const std::string& topic, Visitor&& visit) {
  ros::TopicManager& manager = *ros::TopicManager::instance();
  boost::mutex::scoped_lock lock(manager.*pointer_to(SubscriptionsMutex{}));
  for (const ros::SubscriptionPtr& subscription : manager.*pointer_to(Subscriptions{})) {
    if (subscription->getName() != topic) continue;
    boost::mutex::scoped_lock links((*subscription).*pointer_to(PublisherLinksMutex{}));
    for (const ros::PublisherLinkPtr& link : (*subscription).*pointer_to(PublisherLinks{})) {
      // Without a name the handshake has only begun.
      if (!link->getCallerID().empty()) visit(*link);
    }
  }
}

}  // namespace

std::vector<std::string> topic_writers(const std::string& topic) {
  std::vector<std::string> result;
  for_each_writer(topic, [&](ros::PublisherLink& link) { result.push_back(link.getCallerID()); });
  return result;
}

TopicType topic_type(const std::string& topic) {
  TopicType type;
  for_each_writer(topic, [&type](ros::PublisherLink& link) {
    if (!type.name.empty()) return;
    const ros::Header& header = link.*pointer_to(PublisherHeader{});
    header.getValue("type", type.name);
    header.getValue("md5sum", type.md5sum);
    header.getValue("message_definition", type.definition);
    std::string latching;
    type.is_latched = header.getValue("latching", latching) && latching == "1";
  });
  return type;
}

std::vector<std::string> topic_publishers(const std::string& topic) {
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  std::vector<std::string> result;
  if (!ros::master::execute("getSystemState", request, response, state, false)) return result;
  XmlRpc::XmlRpcValue& published = state[0];  // pairs of a topic and its publishers
  for (int i = 0; i < published.size(); ++i) {
    if (static_cast<std::string&>(published[i][0]) != topic) continue;
    XmlRpc::XmlRpcValue& names = published[i][1];
    for (int k = 0; k < names.size(); ++k) result.push_back(names[k]);
  }
  return result;
}

std::string rivals_text(const std::string& topic, const std::vector<std::string>& publishers) {
  if (publishers.size() < 2) return "";
  return topic + " has " + std::to_string(publishers.size()) + " publishers, " +
         join(publishers, " and ") + ": the robot obeys each of them in turn.";
}

}  // namespace trident::ros_utils
