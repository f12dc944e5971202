// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <std_msgs/UInt8MultiArray.h>

#include "parts.h"
#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_bridges_ros/node_publisher.h"

namespace trident::bridges {

int run_bridge(const ProbeOptions& options) {
  using Message = std_msgs::UInt8MultiArray;
  ros::NodeHandle node;
  NodePollLoop loop;
  NodePublisher<Message> publisher(node, options.out);
  Message out;
  EndpointEvents events;
  events.received = [&](PeerId, Bytes bytes) {
    out.data.assign(bytes.begin(), bytes.end());
    publisher.publish(out);
  };
  events.notice = [](const std::string& text) { ROS_INFO("%s", text.c_str()); };
  events.warning = [](const std::string& text) { ROS_WARN("%s", text.c_str()); };
  EndpointOptions endpoint_options;
  endpoint_options.url = options.url;
  endpoint_options.max_peer_rate = 1e9;  // the greatest rate is what is measured
  const auto endpoint = open_endpoint(endpoint_options, loop.loop(), events);
  const auto subscription =
      loop.subscribe<Message>(node, options.in, 1000, [&](const Message& message) {
        endpoint->send_to_all({message.data.data(), message.data.size()});
      });
  loop.run();
  return 0;
}

}  // namespace trident::bridges
