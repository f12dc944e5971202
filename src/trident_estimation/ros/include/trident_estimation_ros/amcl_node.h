// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/SetMap.h>
#include <ros/ros.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/transform_broadcaster.h>

#include <memory>
#include <optional>
#include <string>

#include "trident_estimation/amcl.h"
#include "trident_estimation_ros/amcl_node_params.h"
#include "trident_estimation_ros/scan_input.h"
#include "trident_ros/diagnostic_counter.h"

namespace trident::estimation {

/// amcl's node. Takes `scan`, tf, `initialpose`, the map (service static_map, topic `map`, service
/// set_map); gives `amcl_pose`, `particlecloud`, tf global -> odom, /diagnostics, the services
/// `global_localization` and `request_nomotion_update`. One thread, that of the caller of
/// ros::spin.
class AmclNode {
 public:
  AmclNode(ros::NodeHandle& node, const ros::NodeHandle& private_node,
           const AmclNodeParams& params);
  ~AmclNode();

 private:
  using Empty = std_srvs::Empty;

  void advertise();
  void ask_for_map();
  bool take_map(const nav_msgs::OccupancyGrid& message);
  void start_pose();
  void on_initial_pose(const geometry_msgs::PoseWithCovarianceStamped& message);
  SE2 motion_since(const ros::Time& stamp) const;
  void on_scan(const PlacedScan& placed);
  void publish_transform(const ros::Time& stamp);
  void publish_pose(const ros::Time& stamp);
  void publish_particles(const ros::Time& stamp);
  void save_pose();
  void publish_diagnostics();

  ros::NodeHandle& node_;
  ros::NodeHandle private_node_;
  AmclNodeParams params_;
  std::string name_;
  ros_utils::DiagnosticCounter troubles_;
  std::unique_ptr<Amcl> amcl_;  ///< once there is a map
  std::optional<SE2> T_global_odom_;
  std::optional<SE2> T_odom_scan_;  ///< odometry of the newest scan
  bool has_pose_ = false;           ///< a scan has been used
  ros::Time last_cloud_;
  std::uint64_t updates_ = 0, searches_ = 0;

  ros::Publisher pose_, cloud_, diagnostics_;
  ros::Subscriber initial_pose_, map_;
  ros::ServiceServer global_localization_, nomotion_update_, set_map_;
  ros::ServiceClient static_map_;
  ros::WallTimer map_timer_, diagnostics_timer_, save_timer_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::unique_ptr<ScanInput> scans_;
};

/// amcl's main(). Returns the exit code.
int amcl_main(int argc, char** argv);

}  // namespace trident::estimation
