// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>

#include "trident_slam/scan_source.h"

namespace trident::slam {

/// What to read of a bag; an empty name is found by itself.
struct BagScansOptions {
  std::string scan_topic;     ///< of sensor_msgs/LaserScan; default: /scan, else the only one
  std::string odom_topic;     ///< of nav_msgs/Odometry; default: /odom, else the only one, if any
  std::string imu_topic;      ///< of sensor_msgs/Imu, to put sweeps right with; default: none
  std::string odom_frame;     ///< default: odom, or the odometry message's
  bool uses_odometry = true;  ///< false: none is looked for
  std::string base_frame;     ///< default: base_footprint, base_link, or the odometry message's
};

/// Laser scans of a rosbag with the odometry of their stamps: from /tf where it has
/// odom_frame -> base_frame, else from an odometry topic. A bag that has neither gives poses that
/// stay where they are, and says so (`has_odometry`). Scans are taken in the order of recording.
class BagScans : public ScanSource {
 public:
  /// Throws Error naming the file when it is no bag, has no index, or has no scans.
  BagScans(std::string path, const BagScansOptions& options);
  ~BagScans() override;

  bool next(ScanRecord& record) override;
  const LogProblems& problems() const override;
  double progress() const override;
  std::string chosen() const override;
  bool has_odometry() const override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trident::slam
