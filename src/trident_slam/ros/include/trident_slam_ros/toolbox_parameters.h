// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>

#include "trident_slam/pose_graph_optimizer.h"

namespace trident::slam {

/// What `solver_plugin` and the `ceres_*` parameters ask for; empty: our own solver. Throws Error
/// naming parameter, value and what is known.
PoseGraphSolverMaker read_solver(const ros::NodeHandle& own);

/// Tells once in the log which of the node's parameters do nothing.
void tell_unused_toolbox_parameters(const ros::NodeHandle& own, bool has_solver);

}  // namespace trident::slam
