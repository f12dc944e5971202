// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

namespace trident::slam {

/// What happens when scans come from more than `bag_loop_threshold` before the last one.
enum class BagLoop { kIgnore, kRestart, kContinue };

struct SlamNodeOptions {
  std::string map_frame = "map";
  std::string odom_frame = "odom";  ///< empty: poses by scans alone, and map -> base is published
  std::string base_frame = "base_footprint";
  std::string scan_topic = "scan";
  std::string imu_topic;  ///< of sensor_msgs/Imu: its turning rate puts sweeps right; empty: none
  std::string map_topic = "map";
  std::string pose_topic = "pose";
  bool uses_mount = true;    ///< false: the laser is taken to sit at the base frame
  int scan_queue_size = 10;  ///< of the subscriber, in asynchronous mode
  bool is_sync = false;      ///< true: every scan is used; false: the newest one, never a queue
  int throttle_scans = 1;
  double transform_publish_period = 0.02;  ///< [s]; 0: map -> odom is not published
  double transform_timeout = 0.2;          ///< [s]
  double tf_buffer_duration = 30.0;        ///< [s]
  double map_update_interval = 5.0;        ///< [s] between two whole maps
  double map_changes_interval = 1.0;       ///< [s] between what is told of changes; 0: none
  double minimum_time_interval = 0.0;      ///< [s] between two scans that are used
  double tf_delay = -1.0;  ///< [s] by which map -> odom is ahead; negative: transform_timeout
  double position_covariance_scale = 1.0;
  double yaw_covariance_scale = 1.0;
  double bag_loop_threshold = 1.0;  ///< [s]
  BagLoop bag_loop = BagLoop::kIgnore;
  std::string autosave_file;       ///< session file; empty: none
  double autosave_interval = 0.0;  ///< [s] of scans that a crash loses at most; 0: no autosave
};

/// Reads the options above from a node's private parameters of the same names; a value that is not
/// legal is an Error with name, value and range.
void read_options(const ros::NodeHandle& private_handle, SlamNodeOptions& options);

/// Their names.
std::vector<std::string> slam_node_parameters();

}  // namespace trident::slam
