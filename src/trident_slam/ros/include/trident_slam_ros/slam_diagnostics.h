// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/ros.h>

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "trident_base/mutex.h"
#include "trident_slam/scan_source.h"
#include "trident_slam/slam_2d.h"
#include "trident_slam/slam_2d_capabilities.h"

namespace trident::slam {

/// What /diagnostics reports of scans before they reach the algorithm.
struct ScanCounts {
  std::size_t received = 0;                ///< All, usable or not.
  std::size_t waiting_for_transforms = 0;  ///< Now.
  std::size_t waiting_for_slam = 0;        ///< Now.
  std::size_t replaced = 0;                ///< By newer ones, while they waited.
  std::size_t left_out = 0;                ///< Refused, or without a transform.
  std::size_t without_gyro = 0;            ///< Used without turning rates.
  std::size_t problems = 0;                ///< Of scans that were received.
  bool is_paused = false;                  ///< Scans are passed over.
};

/// Counts problems of a SLAM node and what its scans led to, and publishes both on /diagnostics.
/// Callable from any thread.
class SlamDiagnostics {
 public:
  /// Advertises /diagnostics. Nothing is published before start().
  explicit SlamDiagnostics(ros::NodeHandle node);

  /// Publishes every second of wall time, in the thread that spins, with what `counts` returns. A
  /// problem since the time before makes it a warning.
  void start(ros::NodeHandle node, std::function<ScanCounts()> counts);

  /// Logs a problem, each kind at most every few seconds, and counts it.
  void report(const std::string& problem);
  /// Logs a problem as report() does, which is counted elsewhere.
  void warn(const std::string& problem);
  /// Counts a problem.
  void count(const std::string& problem);
  /// Takes what a scan led to; its problem is reported. `calibration`: of odometry, as known now.
  void add_scan(const ScanPose2d& pose, std::vector<CalibrationEstimate> calibration);

 private:
  void publish(const ScanCounts& counts);
  void add_problem(const std::string& problem) TRIDENT_REQUIRES(mutex_);
  void warn_throttled(const std::string& problem) TRIDENT_REQUIRES(mutex_);
  void set_level(const ScanCounts& counts, diagnostic_msgs::DiagnosticStatus& status)
      TRIDENT_REQUIRES(mutex_);
  void add_values(const ScanCounts& counts, diagnostic_msgs::DiagnosticStatus& status) const
      TRIDENT_REQUIRES(mutex_);

  ros::Publisher publisher_;
  ros::WallTimer timer_;
  Mutex mutex_;
  LogProblems problems_ TRIDENT_GUARDED_BY(mutex_);
  std::string last_problem_ TRIDENT_GUARDED_BY(mutex_);
  std::map<std::string, ros::WallTime> last_warning_ TRIDENT_GUARDED_BY(mutex_);  ///< By kind.
  std::size_t published_problems_ TRIDENT_GUARDED_BY(mutex_) = 0;
  std::size_t used_ TRIDENT_GUARDED_BY(mutex_) = 0;
  std::vector<CalibrationEstimate> calibration_ TRIDENT_GUARDED_BY(mutex_);
  ScanPose2d newest_ TRIDENT_GUARDED_BY(mutex_);
};

}  // namespace trident::slam
