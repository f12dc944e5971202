// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/buffer.h>

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "trident_base/laser_scan.h"
#include "trident_ros/diagnostic_counter.h"
#include "trident_ros/transform_input.h"

namespace trident::estimation {

/// A scan with what tf knew about it.
struct PlacedScan {
  LaserScan scan;   ///< with the laser's mount from tf
  ros::Time stamp;  ///< of the first beam
  SE2 T_odom_base;  ///< then
  SE2 T_start_end;  ///< the robot's motion while the scan was taken
};

/// Frames that a scan is placed in.
struct ScanInputParams {
  std::string odom_frame_id, base_frame_id;  ///< parent and child of odometry's transform
  double bag_loop_jump = 1.0;                ///< [s]
};

/// What becomes of a scan whose transform is not there.
enum class ScanPatience {
  kWaits,    ///< without a word
  kIsNamed,  ///< what is missing is said, and it waits
  kIsOver    ///< it is given up
};

/// After so long: by the wall clock it is named, by the clock of ROS it is given up. A simulated
/// world that stands until this node has found its place loses no scan, however long it stands.
ScanPatience scan_patience(double wall_s, double ros_s);

/// Subscribes `scan`, holds each back until tf reaches from the odometry's frame to the robot at
/// the scan's time, and hands them over in the order in which they came. Says in `problems` which
/// transform is missing or late, and by how much. A jump of stamps back by more than
/// `bag_loop_jump` clears what was known of time and calls `on_new_time`.
class ScanInput {
 public:
  using Handler = std::function<void(const PlacedScan&)>;  ///< called in the thread that spins
  /// Subscribes at once. `problems` must outlive it.
  ScanInput(ros::NodeHandle& node, const ScanInputParams& params,
            ros_utils::DiagnosticCounter& problems, Handler on_scan,
            std::function<void()> on_new_time);

  /// The robot's pose in the odometry's frame; the newest for time zero. Throws tf2's exceptions.
  SE2 T_odom_base(const ros::Time& stamp) const;
  std::uint64_t received() const { return received_; }  ///< scans, used or not

 private:
  struct Waiting {
    sensor_msgs::LaserScanConstPtr message;
    ros::WallTime since;
    ros::Time since_ros;  ///< the same by the clock of ROS, which may be simulated
    bool is_reported;     ///< that its transform is missing
  };
  struct Laser {
    SE2 T_base_laser;
    bool is_upside_down;  ///< its beams run in the other direction
  };
  /// As it is counted and said.
  struct Problem {
    std::string key, text;
  };
  void receive(const sensor_msgs::LaserScanConstPtr& message);
  void hand_out();
  bool try_first();
  bool place(const sensor_msgs::LaserScan& message, double waited, PlacedScan& placed);
  bool is_refused(const sensor_msgs::LaserScan& message);
  const Laser& laser(const std::string& frame);
  std::optional<Problem> missing_transform(const std::string& target, const std::string& source,
                                           const std_msgs::Header& scan) const;
  bool note_missing(Waiting& waiting, const std::string& reason);
  SE2 looked_up(const std::string& target, const std::string& source, const ros::Time& stamp) const;

  ScanInputParams params_;
  ros_utils::DiagnosticCounter& problems_;
  Handler on_scan_;
  std::function<void()> on_new_time_;
  tf2_ros::Buffer buffer_;
  ros_utils::TransformInput transforms_;
  ros::Subscriber subscriber_;
  ros::WallTimer timer_;
  std::deque<Waiting> waiting_;
  std::map<std::string, Laser> lasers_;  ///< by frame
  ros::Time last_stamp_;
  std::uint64_t received_ = 0;
};

}  // namespace trident::estimation
