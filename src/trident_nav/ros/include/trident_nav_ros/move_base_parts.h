// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>
#include <tf2/buffer_core.h>

#include <memory>
#include <string>

#include "trident_nav/navigator/navigator.h"
#include "trident_nav_ros/costmap_node.h"
#include "trident_nav_ros/move_base_params.h"
#include "trident_nav_ros/planning_thread.h"
#include "trident_nav_ros/staged.h"
#include "trident_ros/refusals.h"

namespace trident::nav {

/// What move_base is made of by its parameters.
struct MoveBaseParts {
  std::string node_name;  ///< Namespace of the parameters: "/move_base".
  ConfigNode tree;        ///< The parameters as they were given.
  MoveBaseParams params;
  ControllerConfig control;
  /// Of parameters and topics, below the node's name: "NavfnROS", "DWAPlannerROS".
  std::string planner_space, controller_space;
  std::unique_ptr<CostmapNode> global, local;
  std::unique_ptr<StagedPlanner> planner;
  std::unique_ptr<StagedController> controller;
  /// In the local costmap's frame; of the thread that updates that costmap.
  std::unique_ptr<MovingObstacles> moving;
  std::unique_ptr<PlanningThread> world;
  std::unique_ptr<Navigator> navigator;
};

/// Makes all parts, and logs a warning for each parameter that has no effect. `buffer` and
/// `refusals` outlive them. Throws Error for parameters that are not legal.
std::unique_ptr<MoveBaseParts> make_move_base_parts(const ros::NodeHandle& private_node,
                                                    const tf2::BufferCore& buffer,
                                                    ros_utils::Refusals& refusals);

/// All parameters below the namespace of a node, a map.
ConfigNode parameters_below(const ros::NodeHandle& private_node);

/// The configuration of one of the costmaps from the node's parameters. Warnings are added.
CostmapConfig costmap_config_of(const ConfigNode& tree, const std::string& node_name,
                                const std::string& name, Warnings* warnings);

/// What the navigator is made of, with new recoveries.
NavigatorParts make_navigator_parts(const MoveBaseParams& params, const ControlSetup& setup,
                                    const ConfigNode& tree, Warnings* warnings);

}  // namespace trident::nav
