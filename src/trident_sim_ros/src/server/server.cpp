// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "server.h"

namespace trident::sim {
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
      spawn_node_(served_by(spawn_queue_, private_node)),
      simulation_(node_, options),
      spinner_(kServiceThreads, &queue_),
      spawn_spinner_(1, &spawn_queue_) {
  subscribe_state_topics(private_node_, simulation_, subscribers_);
  subscribe_run_topics(private_node_, simulation_, subscribers_);
  advertise_state_services(private_node_, simulation_, servers_);
  advertise_property_services(private_node_, simulation_, servers_);
  advertise_force_services(private_node_, simulation_, servers_);
  advertise_run_services(private_node_, simulation_, servers_);
  advertise_radio_service(private_node_, simulation_, servers_);
  advertise_spawn_services(spawn_node_, simulation_, servers_);
  advertise_delete_service(private_node_, simulation_, servers_);  // the last: then all are there
  spinner_.start();
  spawn_spinner_.start();
}

Server::~Server() {
  spawn_spinner_.stop();
  spinner_.stop();
}

}  // namespace trident::sim
