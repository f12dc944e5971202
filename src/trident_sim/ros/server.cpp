// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "server.h"

namespace trident {
namespace {

constexpr std::uint32_t kServiceThreads = 4;

ros::NodeHandle served_by(ros::CallbackQueue& queue, ros::NodeHandle node) {
  node.setCallbackQueue(&queue);
  return node;
}

}  // namespace

Server::Server(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
               const ServerOptions& options)
    : node_(served_by(queue_, node)),
      private_node_(served_by(queue_, private_node)),
      simulation_(node_, options),
      spinner_(kServiceThreads, &queue_) {
  subscribe_state_topics(private_node_, simulation_, subscribers_);
  subscribe_run_topics(private_node_, simulation_, subscribers_);
  advertise_state_services(private_node_, simulation_, servers_);
  advertise_property_services(private_node_, simulation_, servers_);
  advertise_force_services(private_node_, simulation_, servers_);
  advertise_run_services(private_node_, simulation_, servers_);
  advertise_spawn_services(private_node_, simulation_, servers_);
  spinner_.start();
}

Server::~Server() { spinner_.stop(); }

}  // namespace trident
