// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>

#include <memory>

#include "trident_estimation_ros/amcl_diagnostics.h"
#include "trident_estimation_ros/amcl_localizer.h"
#include "trident_estimation_ros/amcl_map_input.h"
#include "trident_estimation_ros/amcl_node_params.h"
#include "trident_estimation_ros/amcl_output.h"
#include "trident_estimation_ros/scan_input.h"
#include "trident_ros/diagnostic_counter.h"

namespace trident::estimation {

/// amcl's node: subscribes to `scan`, tf, `initialpose` and the map (see AmclMapInput), publishes
/// what AmclOutput and AmclDiagnostics do, and serves `global_localization` and
/// `request_nomotion_update`. All runs in one thread, that of the caller of ros::spin.
class AmclNode {
 public:
  /// `node` must outlive it.
  AmclNode(ros::NodeHandle& node, const ros::NodeHandle& private_node,
           const AmclNodeParams& params);
  /// Saves the pose for the next start.
  ~AmclNode();

 private:
  void serve(ros::NodeHandle& node);
  bool take_map(const nav_msgs::OccupancyGrid& message);
  void on_initial_pose(const geometry_msgs::PoseWithCovarianceStamped& message);
  SE2 motion_since(const ros::Time& stamp) const;
  void on_scan(const PlacedScan& placed);
  void save_pose();

  ros::NodeHandle private_node_;
  AmclNodeParams params_;
  ros_utils::DiagnosticCounter problems_;
  AmclLocalizer localizer_;
  AmclOutput output_;
  ros::Subscriber initial_pose_;
  ros::ServiceServer global_localization_, nomotion_update_;
  AmclMapInput map_;
  ScanInput scans_;
  AmclDiagnostics diagnostics_;
  ros::WallTimer save_timer_;
};

/// amcl's main(). Returns the exit code.
int amcl_main(int argc, char** argv);

}  // namespace trident::estimation
