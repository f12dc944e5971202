// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

#include "trident_sim/world.h"

namespace trident::sim {

/// /gazebo/performance_metrics (gazebo_msgs/PerformanceMetrics), five times a second of wall time
/// while somebody listens: the real-time factor since the last message, and of each sensor that is
/// listened to the rates at which it measured.
class PerformanceTopic {
 public:
  explicit PerformanceTopic(ros::NodeHandle& node);

  /// To be called often.
  void publish(const World& world);

 private:
  using Clock = std::chrono::steady_clock;
  void begin(const World& world, Clock::time_point now);

  ros::Publisher publisher_;
  bool is_measuring_ = false;
  Clock::time_point begin_;
  SimTime begin_time_;
  std::map<std::string, std::uint64_t> begin_counts_;  ///< of the sensors' outputs
};

}  // namespace trident::sim
