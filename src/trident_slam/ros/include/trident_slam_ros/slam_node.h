// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "trident_base/mutex.h"
#include "trident_slam/slam_2d.h"
#include "trident_slam_ros/autosave.h"
#include "trident_slam_ros/crash_rescue.h"
#include "trident_slam_ros/guarded_slam.h"
#include "trident_slam_ros/map_server.h"
#include "trident_slam_ros/pose_publisher.h"
#include "trident_slam_ros/scan_queue.h"
#include "trident_slam_ros/scan_receiver.h"
#include "trident_slam_ros/slam_diagnostics.h"
#include "trident_slam_ros/slam_node_options.h"
#include "trident_slam_ros/transform_publisher.h"

namespace trident::slam {

/// Any Slam2d as a ROS node: subscribes to scans and transforms; publishes map, map_metadata,
/// map_updates, map -> odom, pose and /diagnostics. The thread that spins receives scans and queues
/// them with their transforms, another feeds the algorithm. Work that takes longer as the map grows
/// delays neither scans nor map -> odom: maps are drawn and sessions are written from snapshots in
/// threads of their own, and services have one, too.
class SlamNode {
 public:
  using MakeSlam = GuardedSlam::MakeSlam;
  /// Called in the algorithm's thread after each scan.
  using OnScan = std::function<void(const ScanRecord&, const ScanPose2d&)>;

  /// Makes the algorithm and advertises; scans come once run() is called. Throws Error as `make`
  /// does.
  SlamNode(const ros::NodeHandle& private_handle, const SlamNodeOptions& options, MakeSlam make);
  ~SlamNode();
  SlamNode(const SlamNode&) = delete;
  SlamNode& operator=(const SlamNode&) = delete;

  /// Returns when the node is shut down. Throws what ends it before that, in any thread; the map
  /// has then been saved (see rescue()).
  void run();

  /// To be set before run().
  void on_scan(OnScan call) { on_scan_ = std::move(call); }
  /// For services and timers that may take long: their calls come one after the other in a thread
  /// of its own.
  ros::CallbackQueue* slow_queue() { return &slow_queue_; }

  /// Runs `use` on the algorithm between two scans and returns what it returns.
  template <class Use>
  auto with_slam(const Use& use) {
    return slam_.with(use);
  }
  /// Forgets the map.
  void reset();
  /// Throws Error when the algorithm keeps no sessions or the file cannot be written.
  void save_session(const std::string& file) { slam_.session_snapshot()(file); }
  /// Paused, scans are passed over. Callable from any thread.
  void set_paused(bool is_paused) { receiver_.set_paused(is_paused); }
  bool is_paused() const { return receiver_.is_paused(); }  ///< callable from any thread
  /// Held, scans wait: all of them in synchronous mode, else the newest.
  void set_held(bool is_held) { scans_.set_held(is_held); }
  /// Forgets the scans that wait.
  void clear_queue() { scans_.clear(); }
  /// The map as the service dynamic_map returns it.
  nav_msgs::OccupancyGrid map_message() { return map_.message(); }
  /// As map_saver writes it. In synchronous mode it is the map that the offline runner ends with.
  /// Throws Error when it cannot be written.
  void save_map(const std::string& stem);
  /// Logs a problem, each kind now and then, and counts it in /diagnostics.
  void report(const std::string& problem) { diagnostics_.report(problem); }
  /// Counts a problem in /diagnostics.
  void count_problem(const std::string& text) { diagnostics_.count(text); }
  /// After a new map or pose: map -> odom is known again with the next scan.
  void forget_correction() { outputs_.transform.forget(); }

 private:
  /// Why the node ends; empty: it does not.
  struct EndReason {
    Mutex mutex;
    std::string text TRIDENT_GUARDED_BY(mutex);
  };

  /// Where the robot is: /tf, and topics.
  struct Outputs {
    TransformPublisher transform;
    PosePublisher poses;
  };

  void work();
  void consume(const ScanRecord& record);
  void rescue(const std::string& why);

  ros::CallbackQueue slow_queue_;  // outlives what is served from it
  const SlamNodeOptions options_;
  GuardedSlam slam_;
  SlamDiagnostics diagnostics_;
  ScanQueue scans_;
  Outputs outputs_;
  MapServer map_;
  Autosave autosave_;
  OnScan on_scan_;
  ScanReceiver receiver_;
  EndReason end_;
  std::unique_ptr<CrashRescue> crash_rescue_;
  std::thread worker_;
  ros::AsyncSpinner slow_spinner_{1, &slow_queue_};
};

}  // namespace trident::slam
