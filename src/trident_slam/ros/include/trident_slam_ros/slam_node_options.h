// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "trident_base/yaml_config.h"

namespace trident::slam {

/// What happens when scans come from more than `bag_loop_threshold` before the last one.
enum class BagLoop { kIgnore, kRestart, kContinue };

/// Names of the choices in parameters.
constexpr auto enum_names(BagLoop /*tag*/) {
  return std::array{EnumName<BagLoop>{BagLoop::kIgnore, "ignore"},
                    EnumName<BagLoop>{BagLoop::kRestart, "restart"},
                    EnumName<BagLoop>{BagLoop::kContinue, "continue"}};
}

/// What every SLAM node can be set to. The fields of visit() are private parameters; the others
/// depend on the program, or have another parameter in each.
struct SlamNodeOptions {
  std::string map_frame = "map";    ///< frame of the map
  std::string odom_frame = "odom";  ///< empty: poses by scans alone, and map -> base is published
  std::string base_frame = "base_footprint";  ///< frame of the robot
  std::string scan_topic = "scan";            ///< topic of sensor_msgs/LaserScan
  std::string imu_topic;  ///< of sensor_msgs/Imu: its turning rate deskews sweeps; empty: none
  std::string map_topic = "map";    ///< below the node's namespace
  std::string pose_topic = "pose";  ///< below the node's namespace and its private one
  bool uses_mount = true;           ///< false: the laser is taken to sit at the base frame
  int scan_queue_size = 10;         ///< of the subscriber, in asynchronous mode
  bool is_sync = false;    ///< true: every scan is used; false: the newest one, never a queue
  int throttle_scans = 1;  ///< one scan of so many is used
  double transform_publish_period = 0.02;  ///< [s]; 0: map -> odom is not published
  double transform_timeout = 0.2;          ///< [s]
  double tf_buffer_duration = 30.0;        ///< [s]
  double map_update_interval = 5.0;        ///< [s] between two whole maps
  double map_changes_interval = 1.0;       ///< [s] between two updates of the map; 0: none
  double minimum_time_interval = 0.0;      ///< [s] between two scans that are used
  double tf_delay = -1.0;  ///< [s] by which map -> odom is ahead; negative: transform_timeout
  double position_covariance_scale = 1.0;  ///< factor of the published variances of x and y
  double yaw_covariance_scale = 1.0;       ///< factor of the published variance of yaw
  double bag_loop_threshold = 1.0;         ///< [s]
  BagLoop bag_loop = BagLoop::kIgnore;     ///< see docs/howto/slam.md
  std::string autosave_file;               ///< session file; empty: none
  double autosave_interval = 0.0;  ///< [s] of scans that a crash loses at most; 0: no autosave

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("map_frame", map_frame, "frame of the map");
    ar.field("odom_frame", odom_frame,
             "frame of odometry; empty: poses by scans alone, and map -> base is published");
    ar.field("base_frame", base_frame, "frame of the robot");
    ar.field("scan_topic", scan_topic, "topic of sensor_msgs/LaserScan");
    ar.field("imu_topic", imu_topic,
             "topic of sensor_msgs/Imu: its turning rate deskews sweeps; empty: none");
    ar.field("throttle_scans", throttle_scans, Range::at_least(1), "one scan of so many is used");
    visit_times(ar);
    ar.field("position_covariance_scale", position_covariance_scale, Range::non_negative(),
             "factor of the published variances of x and y");
    ar.field("yaw_covariance_scale", yaw_covariance_scale, Range::non_negative(),
             "factor of the published variance of yaw");
    ar.field("bag_loop", bag_loop, "what follows when time goes back: see docs/howto/slam.md");
    ar.field("bag_loop_threshold", bag_loop_threshold, Range::non_negative(),
             "stamps that go back by more are of a bag that begins again [s]");
    ar.field("autosave_file", autosave_file, "session file; empty: none");
    ar.field("autosave_interval", autosave_interval, Range::non_negative(),
             "scans that a crash loses at most; 0: no autosave [s]");
  }

 private:
  template <class Archive>
  void visit_times(Archive& ar) {
    ar.field("transform_publish_period", transform_publish_period, Range::non_negative(),
             "period of map -> odom; 0: it is not published [s]");
    ar.field("transform_timeout", transform_timeout, Range::non_negative(),
             "how long a scan waits for its transform [s]");
    ar.field("tf_buffer_duration", tf_buffer_duration, Range::at_least(0.1),
             "how long transforms are kept [s]");
    ar.field("map_update_interval", map_update_interval, Range::non_negative(),
             "between two whole maps [s]");
    ar.field("map_changes_interval", map_changes_interval, Range::non_negative(),
             "between two updates of the map; 0: none [s]");
    ar.field("minimum_time_interval", minimum_time_interval, Range::non_negative(),
             "between two scans that are used [s]");
  }
};

}  // namespace trident::slam
