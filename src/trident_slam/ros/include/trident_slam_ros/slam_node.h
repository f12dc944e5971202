// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/GetMap.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2/buffer_core.h>
#include <tf2_ros/transform_broadcaster.h>

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "trident_ros/transform_input.h"
#include "trident_slam/slam_2d.h"
#include "trident_slam/slam_2d_abilities.h"
#include "trident_slam_ros/autosave.h"
#include "trident_slam_ros/background_task.h"
#include "trident_slam_ros/crash_rescue.h"
#include "trident_slam_ros/map_publisher.h"
#include "trident_slam_ros/scan_intake.h"
#include "trident_slam_ros/scan_stamps.h"
#include "trident_slam_ros/slam_node_options.h"

namespace trident::slam {

/// Any Slam2d as a ROS node: scans and transforms in; map, map_metadata, map_updates, map -> odom,
/// pose and /diagnostics out. Scans wait for their transforms; a thread of its own feeds the
/// algorithm. Nothing that takes longer as the map grows holds up the scans or map -> odom: maps
/// are drawn and sessions are written from snapshots in threads of their own, and services have
/// one, too.
class SlamNode {
 public:
  using MakeSlam = std::function<std::unique_ptr<Slam2d>()>;
  /// Called in the algorithm's thread after each scan.
  using OnScan = std::function<void(const ScanRecord&, const ScanPose2d&)>;

  SlamNode(const ros::NodeHandle& private_handle, const SlamNodeOptions& options, MakeSlam make);
  ~SlamNode();
  SlamNode(const SlamNode&) = delete;
  SlamNode& operator=(const SlamNode&) = delete;

  /// Until the node is shut down. What ends it before that, in any thread, is an exception here,
  /// and the map has been saved (see rescue()).
  void run();

  void on_scan(OnScan call) { on_scan_ = std::move(call); }
  /// For services and timers that may take long: their calls come one after the other in a thread
  /// of its own.
  ros::CallbackQueue* slow_queue() { return &slow_queue_; }

  /// Runs `use` on the algorithm between two scans and returns what it returns.
  template <class Use>
  auto with_slam(const Use& use) {
    const std::lock_guard<std::mutex> lock(slam_mutex_);
    return use(*slam_);
  }
  /// Forgets the map.
  void reset();
  /// Throws Error when the algorithm keeps no sessions or the file cannot be written.
  void save_session(const std::string& file);
  void set_paused(bool is_paused) { is_paused_ = is_paused; }
  bool is_paused() const { return is_paused_; }
  /// Held, scans wait: all of them in synchronous mode, else the newest.
  void set_held(bool is_held);
  /// Forgets the scans that wait.
  void clear_queue();
  nav_msgs::OccupancyGrid map_message();
  /// As map_saver writes it. In synchronous mode it is the map that the offline runner ends with.
  /// Throws Error when it cannot be written.
  void save_map(const std::string& stem);
  /// Tells a problem in the log, each kind now and then, and counts it in /diagnostics.
  void tell(const std::string& problem);
  /// Counts a problem in /diagnostics.
  void count_problem(const std::string& text);
  /// After a new map or pose: map -> odom is known again with the next scan.
  void forget_correction();

 private:
  void receive_scan(const sensor_msgs::LaserScanConstPtr& message);
  void receive_imu(const sensor_msgs::ImuConstPtr& message) { intake_.add(*message); }
  void follow_time(const ScanStamps::Step& step);
  void take_scan(const sensor_msgs::LaserScanConstPtr& message);
  bool is_in_bag_loop(const sensor_msgs::LaserScan& message);
  void hand_over();
  void work();
  void consume(const ScanRecord& record);
  void rescue(const std::string& why);
  void save_what_there_is() const;  ///< of `slam_`, whose lock is held
  void publish_pose(const ScanRecord& record, const ScanPose2d& pose);
  void publish_correction();
  void publish_map_if_due(const ros::Time& now);
  std::function<void(const std::string&)> session_snapshot();
  std::function<OccupancyGrid()> map_snapshot();
  nav_msgs::OccupancyGrid to_message(const OccupancyGrid& map) const;
  void publish_diagnostics();
  bool get_map(nav_msgs::GetMap::Request& request, nav_msgs::GetMap::Response& response);
  std::unique_ptr<Slam2d> new_slam() const;
  void complain(const std::string& text);  ///< with `queue_mutex_` held

  ros::CallbackQueue slow_queue_;  // outlives what is served from it
  SlamNodeOptions options_;
  MakeSlam make_;
  std::mutex slam_mutex_;
  std::unique_ptr<Slam2d> slam_;
  OnScan on_scan_;

  tf2::BufferCore transforms_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ScanIntake intake_;
  ScanStamps stamps_;
  ros::Time last_taken_;
  std::size_t count_ = 0;
  std::atomic<bool> is_looping_{false};
  ros::Time looping_until_;

  std::mutex queue_mutex_;  // guards what follows, up to the publishers
  std::condition_variable queue_changed_;
  std::deque<ScanRecord> queue_;
  bool is_ending_ = false;
  bool is_held_ = false;
  bool has_correction_ = false;
  SE2 T_map_odom_;
  ros::Time last_correction_;
  std::size_t used_ = 0;
  std::size_t dropped_ = 0;
  LogProblems problems_;
  std::string last_problem_;
  std::map<std::string, ros::WallTime> complaints_;
  std::string end_reason_;  ///< why the node ends; empty: it does not
  std::size_t told_problems_ = 0;
  std::size_t told_late_ = 0;
  std::vector<CalibrationEstimate> calibration_;  ///< of odometry, with the newest scan
  ScanPose2d newest_;                             ///< what the newest scan led to
  std::atomic<bool> is_paused_{false};

  std::unique_ptr<ros_utils::TransformInput> transform_input_;
  std::unique_ptr<MapPublisher> map_publisher_;
  std::vector<ros::Publisher> pose_publishers_;
  ros::Publisher diagnostics_publisher_;
  ros::Subscriber scan_subscriber_;
  ros::Subscriber imu_subscriber_;
  ros::ServiceServer map_service_;
  ros::WallTimer intake_timer_;
  ros::Timer correction_timer_;
  ros::WallTimer diagnostics_timer_;
  BackgroundTask map_task_;
  Autosave autosave_;
  std::thread worker_;
  std::unique_ptr<CrashRescue> crash_rescue_;
  ros::AsyncSpinner slow_spinner_{1, &slow_queue_};
};

}  // namespace trident::slam
