// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <string>
#include <vector>

#include "trident_base/mutex.h"
#include "trident_nav_ros/move_base_parts.h"
#include "trident_ros/reconfigure_server.h"
#include "trident_ros/refusals.h"

namespace trident::nav {

/// Serves dynamic_reconfigure for move_base, its planner, its controller, both costmaps and their
/// layers, below upstream's names. What is changed is made again in the thread of the service and
/// taken over by the others when they next look: no part changes while it is used.
class Reconfiguration {
 public:
  /// `parts` and `refusals` outlive it.
  Reconfiguration(const ros::NodeHandle& private_node, MoveBaseParts& parts,
                  ros_utils::Refusals& refusals);

  /// Gives the navigator, unless it is recovering, and what tracks moving obstacles the parameters
  /// that have changed; called by the thread that steps them, between the steps.
  void apply();

 private:
  void serve_node();
  void serve_planner();
  void serve_controller();
  void serve_costmap(CostmapNode& costmap, const std::string& name);
  void serve_layer(CostmapNode& costmap, const std::string& name, const LayerSpec& spec);
  void add_server(const std::string& name_space, const std::vector<ConfigField>& fields,
                  const ConfigNode& values, ros_utils::ReconfigureServer::Apply apply);

  void change_node(const ConfigNode& values);
  void change_planner(const ConfigNode& values);
  void change_controller(const ConfigNode& values);
  void change_footprint();
  void stage(const MoveBaseParams& params, const ControllerConfig& control)
      TRIDENT_REQUIRES(mutex_);

  ros::NodeHandle node_;
  MoveBaseParts& parts_;
  ros_utils::Refusals& refusals_;
  Mutex mutex_;
  MoveBaseParams params_ TRIDENT_GUARDED_BY(mutex_);     ///< The newest ones.
  ControllerConfig control_ TRIDENT_GUARDED_BY(mutex_);  ///< The newest one.
  Staged<NavigatorParts> navigator_;
  Staged<MovingObstacleParams> moving_;
  std::vector<std::unique_ptr<ros_utils::ReconfigureServer>> servers_;
};

}  // namespace trident::nav
