// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "trident_ros/node_params.h"

namespace trident::control {

/// A node whose hot loop is served by the thread that calls it.
class RunningNode {
 public:
  RunningNode() = default;
  RunningNode(const RunningNode&) = delete;
  RunningNode& operator=(const RunningNode&) = delete;
  virtual ~RunningNode() = default;
  /// Handles what has come, or comes within `limit`.
  virtual void spin_once(std::chrono::milliseconds limit) = 0;
};
/// Makes a node that has read its parameters.
using NodeFactory = std::function<std::unique_ptr<RunningNode>(ros::NodeHandle& node,
                                                               ros_utils::NodeParams& params)>;

/// main() of a node: initialises ROS, makes the node, logs notes on its parameters, and spins.
/// SIGINT and SIGTERM end it within a second even when the master does not answer, and also while
/// it still waits for a master. /clock is not subscribed to. Returns 0, or 1 after an error in the
/// parameters, which is logged.
int run_node(int argc, char** argv, const std::string& name, const NodeFactory& make_node);

/// Logs which of RotorS' parameters are not set, and which parameters are not known.
void log_notes(const ros_utils::NodeParams& params);

/// Under simulated time, makes `stamp` the time of what this process logs next.
void set_log_time(const ros::Time& stamp);

}  // namespace trident::control
