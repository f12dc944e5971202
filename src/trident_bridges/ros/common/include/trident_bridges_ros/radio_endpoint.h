// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "trident_bridges/transport/endpoint.h"
#include "trident_bridges_ros/node_poll_loop.h"

namespace trident::bridges {

/// A URL of an endpoint that is a robot's simulated radio (docs/explanation/links.md):
/// - radio://ROBOT[@DESTINATION][/TOPIC][?priority=P&deadline=S]
/// - radio:DESTINATION[/TOPIC][?...]: of the robot whose namespace the node has.
/// Without a destination, and with the destination "all", blocks are broadcasts.
struct RadioUrl {
  std::string robot;             ///< empty: the node's namespace
  std::string destination;       ///< empty: all
  std::string topic = "bridge";  ///< RadioPacket::topic; packets of another one are not received
  int priority = 1;              ///< 0 goes first, up to 3
  double deadline_s = 0.0;       ///< blocks that were not sent by then are dropped; 0: never [s]
};

/// Whether a URL is one of a radio, legal or not.
bool is_radio_url(std::string_view text);

/// Throws Error with the URL, the field, the value and the legal range.
RadioUrl parse_radio_url(std::string_view text);

/// As open_endpoint(), and takes radio URLs, too: a block is one trident_msgs/RadioPacket, peers
/// are robots by name, and a robot's radio can have one endpoint in a process. `loop` and `node`
/// must outlive the endpoint, which is destroyed in the loop's thread and outside of its handlers.
/// Throws Error.
std::unique_ptr<Endpoint> open_node_endpoint(const EndpointOptions& options, NodePollLoop& loop,
                                             ros::NodeHandle& node, EndpointEvents events);

}  // namespace trident::bridges
