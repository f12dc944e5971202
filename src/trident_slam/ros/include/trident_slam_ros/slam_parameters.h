// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <memory>
#include <string>

#include "trident_slam/graph_slam_options.h"
#include "trident_slam/pose_graph_optimizer.h"
#include "trident_slam/slam_2d.h"

namespace trident::slam {

/// Where the parameters `method` (default: `usual`) and `config_file` ask for graph_slam_2d with a
/// YAML file, replaces `graph` by the options of that file. Throws Error naming file, line, key,
/// value and range.
void read_graph_file(const ros::NodeHandle& private_handle, const std::string& usual,
                     GraphSlamOptions& graph);

/// graph_slam_2d's options: those of its file (see read_graph_file), else private parameters of the
/// same names. Wrong types and values are Errors as in a YAML file.
GraphSlamOptions read_graph_options(const ros::NodeHandle& private_handle);

/// What makes the algorithm of a node: the parameter `method` (default: `usual`). graph_slam_2d
/// takes `graph` and `solver`; the others take the YAML file `config_file` if given, without it
/// particle_slam_2d and hector_slam_2d private parameters of the names that theirs have. Throws
/// Error for an unknown method.
std::function<std::unique_ptr<Slam2d>()> slam_maker(const ros::NodeHandle& private_handle,
                                                    const std::string& usual,
                                                    const GraphSlamOptions& graph,
                                                    const PoseGraphSolverMaker& solver = {});

}  // namespace trident::slam
