// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "trident_slam/graph_slam_options.h"
#include "trident_slam/pose_graph_optimizer.h"
#include "trident_slam/slam_2d.h"

namespace trident {

/// Reads graph_slam_2d's options from private parameters of the same names. Wrong types and
/// values are Errors as in a YAML file.
GraphSlamOptions read_graph_options(const ros::NodeHandle& private_handle);

/// What makes the algorithm of a node: the parameter `method` (default: the first of `usual` that
/// there is), with the YAML file `config_file` if given; without a file graph_slam_2d takes
/// `graph` and `solver`, particle_slam_2d and hector_slam_2d private parameters of the names that
/// theirs have. Throws Error for an unknown method.
std::function<std::unique_ptr<Slam2d>()> slam_maker(const ros::NodeHandle& private_handle,
                                                    const std::vector<std::string>& usual,
                                                    const GraphSlamOptions& graph,
                                                    const PoseGraphSolverMaker& solver = {});

}  // namespace trident
