// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <string>
#include <vector>

#include "services/services.h"
#include "simulation/simulation.h"

namespace trident::sim {

/// A simulation with its services and topics: the process gzserver, or a nodelet.
class Server {
 public:
  /// Throws Error when an option is bad or the world cannot be loaded. `private_node`: /gazebo.
  Server(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
         const ServerOptions& options);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Steps until the end of the run or of ROS, or stop(). Returns the reason of the end.
  std::string run() { return simulation_.run(); }
  /// From any thread.
  void stop() { simulation_.stop(); }
  /// The run has ended with an error, which was logged.
  bool failed() const { return !simulation_.error().empty(); }

 private:
  ros::CallbackQueue queue_;        ///< of services: one may wait for steps while others are asked
  ros::CallbackQueue spawn_queue_;  ///< a model that takes long to read keeps nobody else waiting
  ros::NodeHandle node_, private_node_, spawn_node_;
  Simulation simulation_;
  Servers servers_;
  std::vector<ros::Subscriber> subscribers_;
  ros::AsyncSpinner spinner_, spawn_spinner_;
};

}  // namespace trident::sim
