// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/GetMap.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

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

#include "trident_slam/slam_2d.h"
#include "trident_slam/slam_2d_abilities.h"
#include "trident_slam_ros/background_task.h"
#include "trident_slam_ros/map_publisher.h"
#include "trident_slam_ros/scan_intake.h"

namespace trident {

/// What happens when scans come from more than `bag_loop_threshold` before the last one.
enum class BagLoop { kIgnore, kRestart, kContinue };

struct SlamNodeOptions {
  std::string map_frame = "map";
  std::string odom_frame = "odom";
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
const std::vector<std::string>& slam_node_parameters();

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
  /// Counts a problem in /diagnostics.
  void count_problem(const std::string& text);
  /// After a new map or pose: map -> odom is known again with the next scan.
  void forget_correction();

 private:
  void receive_scan(const sensor_msgs::LaserScanConstPtr& message);
  void receive_imu(const sensor_msgs::ImuConstPtr& message) { intake_.add(*message); }
  bool is_bag_loop(const sensor_msgs::LaserScan& message);
  void hand_over();
  void work();
  void consume(const ScanRecord& record);
  void publish_pose(const ScanRecord& record, const ScanPose2d& pose);
  void publish_correction();
  void publish_map_if_due(const ros::Time& now);
  bool is_autosaving() const;
  void wait_for_autosave(const ros::Time& now);
  void autosave_if_due(const ros::Time& now);
  void autosave(const ros::Time& now);
  std::function<OccupancyGrid()> map_snapshot();
  nav_msgs::OccupancyGrid to_message(const OccupancyGrid& map) const;
  void tell(const std::string& problem);
  void publish_diagnostics();
  bool get_map(nav_msgs::GetMap::Request& request, nav_msgs::GetMap::Response& response);
  void complain(const std::string& text);  ///< with `queue_mutex_` held

  SlamNodeOptions options_;
  MakeSlam make_;
  std::mutex slam_mutex_;
  std::unique_ptr<Slam2d> slam_;
  OnScan on_scan_;

  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ScanIntake intake_;
  ros::Time last_stamp_;
  ros::Time last_taken_;
  std::size_t count_ = 0;
  std::atomic<bool> is_looping_{false};

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
  std::size_t told_problems_ = 0;
  std::size_t told_late_ = 0;
  std::vector<CalibrationEstimate> calibration_;  ///< of odometry, with the newest scan
  std::atomic<bool> is_paused_{false};

  ros::Time last_scan_;
  ros::Time last_autosave_;  ///< the newest scan in the session that was begun last
  ros::Time safe_until_;     ///< the newest scan in the session that is on the disk
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
  BackgroundTask autosave_task_;
  std::thread worker_;
  ros::CallbackQueue slow_queue_;
  ros::AsyncSpinner slow_spinner_{1, &slow_queue_};
};

}  // namespace trident
