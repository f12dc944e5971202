// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/time.h>
#include <sensor_msgs/LaserScan.h>

#include <optional>
#include <string>
#include <vector>

namespace trident::slam {

/// Distinguishes a bag that begins again from a single scan with a wrong stamp. A scan from far
/// before the newest is held back until a second one agrees with it; one that was far ahead is
/// recognized when later scans continue from before it. No clock.
class ScanStamps {
 public:
  /// `threshold` [s]: by less than this any scan may be older than the newest.
  explicit ScanStamps(double threshold) : threshold_(threshold) {}

  /// What a scan led to. `scans` is empty while a scan is held back.
  struct Step {
    std::vector<sensor_msgs::LaserScanConstPtr> scans;  ///< to be taken now, in order
    std::optional<ros::Duration> went_back;             ///< time did, before these scans
    std::optional<ros::Time> back_from;                 ///< the newest stamp before it did
    std::string problem;                                ///< of a scan that is left out; or empty
    bool was_ahead = false;  ///< scans that wait and are newer than these are to be left out
  };
  /// Stamps must be such that ROS can subtract them (see stamp_problem()).
  Step add(const sensor_msgs::LaserScanConstPtr& message);

 private:
  Step add_older(const sensor_msgs::LaserScanConstPtr& message);

  double threshold_;
  ros::Time newest_;
  ros::Time before_jump_;  ///< the newest stamp before it jumped ahead; zero: it did not
  sensor_msgs::LaserScanConstPtr suspect_;  ///< from far before the newest
};

}  // namespace trident::slam
