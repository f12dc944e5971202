// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "trident_slam/slam_2d.h"

namespace trident::slam {

/// The algorithm of a node behind a mutex: it is used between two scans only.
class GuardedSlam {
 public:
  using MakeSlam = std::function<std::unique_ptr<Slam2d>()>;

  /// Without odometry the method must be a Slam2dOdometryUse. Throws Error otherwise, and as `make`
  /// does.
  GuardedSlam(MakeSlam make, bool uses_odometry);

  /// Runs `use` on the algorithm and returns what it returns.
  template <class Use>
  auto with(const Use& use) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return use(*slam_);
  }
  /// Forgets the map.
  void reset();
  /// Draws the map as it is now, in any thread and without the mutex.
  std::function<OccupancyGrid()> map_snapshot();
  /// Writes the session as it is now, in any thread and without the mutex. Throws Error when the
  /// method keeps no sessions.
  std::function<void(const std::string& file)> session_snapshot();

  /// Writes session and map as STEM.* before the process ends. Prints what cannot be written.
  void rescue(const std::string& stem);
  /// The same in a signal handler: does not wait for a thread that holds the mutex for ever.
  void rescue_after_crash(const std::string& stem);

 private:
  std::unique_ptr<Slam2d> make_slam() const;
  void save_all(const std::string& stem) const;

  MakeSlam make_;
  bool uses_odometry_;
  std::mutex mutex_;  // std::mutex, since a signal handler may only try to take it
  std::unique_ptr<Slam2d> slam_;
};

}  // namespace trident::slam
