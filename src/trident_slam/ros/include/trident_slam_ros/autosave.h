// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/time.h>

#include <functional>
#include <string>

#include "trident_slam_ros/background_task.h"

namespace trident::slam {

/// Keeps a session file that is never farther behind the scans than an interval of their stamps.
/// All calls come from the thread that feeds the algorithm.
class Autosave {
 public:
  using Write = std::function<void(const std::string& file)>;
  /// This call is quick; what it returns writes the session as it is now, in any thread. Both may
  /// throw Error.
  using Snapshot = std::function<Write()>;
  /// Hears of problems, in any thread.
  using OnProblem = std::function<void(const std::string& problem)>;

  /// Saves nothing when `file` is empty or `interval` [s] is 0.
  Autosave(std::string file, double interval, Snapshot snapshot, OnProblem on_problem);

  /// To be called before the algorithm gets a scan. One that would be farther than the interval
  /// from what is on the disk waits until the session that is being written is there.
  void before_scan(const ros::Time& stamp);
  /// To be called when the algorithm has the scan.
  void after_scan(const ros::Time& stamp);
  /// After the last scan: writes what the file lacks, and returns when it is there.
  void finish();

 private:
  bool is_on() const { return !file_.empty() && interval_ > 0.0; }
  void save(const ros::Time& stamp);

  std::string file_;
  double interval_;
  Snapshot snapshot_;
  OnProblem on_problem_;
  ros::Time last_scan_;
  ros::Time last_saved_;  ///< the newest scan in the session that was begun last
  ros::Time safe_until_;  ///< the newest scan in the session that is on the disk
  BackgroundTask task_;
};

}  // namespace trident::slam
