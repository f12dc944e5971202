// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>

#include "trident_control_ros/parameters.h"

namespace trident {

/// A running node; destroying it ends its subscriptions.
using RunningNode = std::shared_ptr<void>;
/// Makes a node that has read its parameters.
using NodeFactory = std::function<RunningNode(ros::NodeHandle& node, ParameterTree& parameters)>;

/// main() of a node that works on roscpp's socket thread only: initialises ROS, makes the node,
/// logs notes on its parameters, and waits. SIGINT and SIGTERM end it within a second even when the
/// master does not answer, and also while it still waits for a master. /clock is not subscribed to.
/// Returns 0, or 1 after an error in the parameters, which is logged.
int run_node(int argc, char** argv, const std::string& name, const NodeFactory& make_node);

/// Under simulated time, makes `stamp` the time of what this process logs next.
void set_log_time(const ros::Time& stamp);

}  // namespace trident
