// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2/buffer_core.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>

#include "trident_ros/transform_input.h"
#include "trident_slam_ros/scan_intake.h"
#include "trident_slam_ros/scan_queue.h"
#include "trident_slam_ros/scan_stamps.h"
#include "trident_slam_ros/slam_diagnostics.h"
#include "trident_slam_ros/slam_node_options.h"

namespace trident::slam {

/// Subscribes to scans, transforms and turning rates, and pushes the scans that are to be used into
/// the queue, each with its odometry. Its callbacks run in the thread that spins.
class ScanReceiver {
 public:
  /// `on_restart`: time went back, and the map is to begin again. The references must outlive it.
  ScanReceiver(ros::NodeHandle node, const SlamNodeOptions& options, ScanQueue& queue,
               SlamDiagnostics& diagnostics, std::function<void()> on_restart);
  ScanReceiver(const ScanReceiver&) = delete;
  ScanReceiver& operator=(const ScanReceiver&) = delete;

  /// Receives nothing more.
  void stop();
  /// Paused, scans are passed over. Callable from any thread.
  void set_paused(bool is_paused) { is_paused_ = is_paused; }
  bool is_paused() const { return is_paused_; }  ///< callable from any thread
  /// Scans are used even if time went back, since the map is a new one. Callable from any thread.
  void end_bag_loop() { bag_loop_.is_active = false; }
  /// The counts of scans, for the thread that spins.
  ScanCounts counts();

 private:
  void receive(const sensor_msgs::LaserScanConstPtr& message);
  void follow_time(const ScanStamps::Step& step);
  void take(const sensor_msgs::LaserScanConstPtr& message);
  bool is_in_bag_loop(const sensor_msgs::LaserScan& message);
  void hand_over();
  void subscribe(ros::NodeHandle& node);

  /// Time that was mapped before it went back: its scans are passed over.
  struct PassedTime {
    std::atomic<bool> is_active{false};
    ros::Time end;
  };
  struct Inputs {
    std::unique_ptr<ros_utils::TransformInput> transforms;
    ros::Subscriber scans, imu;
  };
  struct Throttle {
    ros::Time last;         ///< Stamp of the last scan that was used.
    std::size_t count = 0;  ///< Scans that were long enough after it.
  };

  const SlamNodeOptions options_;
  ScanQueue& queue_;
  SlamDiagnostics& diagnostics_;
  std::function<void()> on_restart_;
  tf2::BufferCore transforms_;
  ScanIntake intake_;
  ScanStamps stamps_;
  Throttle throttle_;
  std::size_t reported_problems_ = 0;  ///< Of the intake.
  std::atomic<bool> is_paused_{false};
  PassedTime bag_loop_;
  Inputs inputs_;
  ros::WallTimer timer_;
};

}  // namespace trident::slam
