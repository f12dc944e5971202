// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/NavSatFix.h>
#include <trident_msgs/GnssStatus.h>

#include <memory>
#include <string>
#include <vector>

#include "trident_base/utc_clock.h"
#include "trident_bridges/nmea/send/gnss_talker.h"
#include "trident_bridges/nmea/send/instrument_talker.h"
#include "trident_bridges_ros/nmea/nmea_node_params.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_ros/refusals.h"

namespace trident::bridges {

/// Reads a vehicle's instruments from topics and has sentences made of them.
class VehicleInput {
 public:
  /// Subscribes below `node`'s namespace. The references outlive the input.
  VehicleInput(ros::NodeHandle& node, NodePollLoop& loop, const NmeaTopicParams& topics,
               nmea::SentenceSender& sender, const UtcClock& clock, ros_utils::Refusals& refusals);

 private:
  template <class Message, class Handler>
  void listen(const std::string& topic, const Handler& handler);
  void on_fix(const sensor_msgs::NavSatFix& message);
  void on_status(const trident_msgs::GnssStatus& message);
  void on_odometry(const nav_msgs::Odometry& message);
  bool accept(const std::string& topic, const std::string& problem);

  ros::NodeHandle& node_;
  NodePollLoop& loop_;
  ros_utils::Refusals& refusals_;
  nmea::GnssTalker gnss_;
  nmea::InstrumentTalker instruments_;
  nmea::GnssJoin join_;
  std::vector<double> shaft_rpm_;
  const ros_utils::DirectSubscription* status_ = nullptr;  ///< of gnss_status
  std::vector<std::unique_ptr<ros_utils::DirectSubscription>> subscriptions_;
};

}  // namespace trident::bridges
