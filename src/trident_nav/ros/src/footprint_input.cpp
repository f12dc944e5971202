// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/footprint_input.h"

#include <geometry_msgs/PolygonStamped.h>
#include <ros/message_event.h>
#include <ros/names.h>
#include <ros/this_node.h>

#include <boost/function.hpp>
#include <utility>

namespace trident::nav {
namespace {

template <class Message>
Message decoded(const AnyMessage& message) {
  Message result;
  std::vector<std::uint8_t> bytes = message.bytes;
  ros::serialization::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(stream, result);
  return result;
}

}  // namespace

FootprintInput::FootprintInput(ros::NodeHandle& node, const std::string& topic,
                               std::function<void(const geometry_msgs::Polygon& polygon)> take,
                               std::function<void(const std::string& problem)> refuse) {
  using Event = ros::MessageEvent<const AnyMessage>;
  const boost::function<void(const Event&)> receive = [take = std::move(take),
                                                       refuse = std::move(refuse)](
                                                          const Event& event) {
    if (event.getPublisherName() == ros::this_node::getName()) return;
    const auto& header = event.getConnectionHeader();
    const auto type = header.find("type");
    const std::string name = type == header.end() ? "" : type->second;
    try {
      if (name == "geometry_msgs/Polygon") {
        take(decoded<geometry_msgs::Polygon>(*event.getConstMessage()));
      } else if (name == "geometry_msgs/PolygonStamped") {
        take(decoded<geometry_msgs::PolygonStamped>(*event.getConstMessage()).polygon);
      } else {
        refuse("it is a " + name + " of node " + event.getPublisherName() +
               ", legal: geometry_msgs/Polygon, geometry_msgs/PolygonStamped");
      }
    } catch (const ros::serialization::StreamOverrunException& error) {
      refuse("it is cut short: " + std::string(error.what()));
    }
  };
  subscriber_ = node.subscribe<AnyMessage>(topic, 1, receive);
}

}  // namespace trident::nav
