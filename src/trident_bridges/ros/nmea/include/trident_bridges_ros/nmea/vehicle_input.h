// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/NavSatFix.h>
#include <trident_msgs/GnssStatus.h>

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/utc_clock.h"
#include "trident_bridges/nmea/send/ais_transmitter.h"
#include "trident_bridges/nmea/send/gnss_talker.h"
#include "trident_bridges/nmea/send/instrument_talker.h"
#include "trident_bridges_ros/nmea/nmea_node_params.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_ros/refusals.h"

namespace trident::bridges {

/// Who else wants to know what a vehicle does.
struct VehicleHooks {
  /// After each fix, with the newest velocity and heading; may be empty.
  std::function<void(SimTime, const nmea::AisState&, double altitude_m)> fixed;
  /// After each odometry, with its frame and the place in it [m]; may be empty.
  std::function<void(SimTime, const std::string& frame, const Eigen::Vector2d& p_frame,
                     const nmea::GroundVelocity&)>
      moved;
};

/// Reads a vehicle's instruments from topics and has sentences made of them.
class VehicleInput {
 public:
  /// Subscribes below `node`'s namespace. `frame_heading_rad`: of the odometry frame's x,
  /// counter-clockwise from east. The references outlive the input.
  VehicleInput(ros::NodeHandle& node, NodePollLoop& loop, const NmeaTopicParams& topics,
               double frame_heading_rad, nmea::SentenceSender& sender, const UtcClock& clock,
               ros_utils::Refusals& refusals, VehicleHooks hooks);

 private:
  template <class Message, class Handler>
  void listen(const std::string& topic, const Handler& handler);
  void on_fix(const sensor_msgs::NavSatFix& message);
  void on_status(const trident_msgs::GnssStatus& message);
  void on_odometry(const nav_msgs::Odometry& message);
  void on_epoch(const nmea::GnssEpoch& epoch);
  void listen_to_water(const NmeaTopicParams& topics);
  void listen_to_machinery(const NmeaTopicParams& topics);
  bool accept(const std::string& topic, const std::string& problem);

  ros::NodeHandle& node_;
  NodePollLoop& loop_;
  ros_utils::Refusals& refusals_;
  VehicleHooks hooks_;
  Eigen::Quaterniond R_enu_frame_;  ///< of the odometry's frame
  nmea::GnssTalker gnss_;
  nmea::InstrumentTalker instruments_;
  nmea::GnssJoin join_;
  std::optional<nmea::GroundVelocity> velocity_;  ///< the newest
  std::optional<nmea::Attitude> attitude_;        ///< the newest
  std::vector<double> shaft_rpm_;
  const ros_utils::DirectSubscription* status_ = nullptr;  ///< of gnss_status
  std::vector<std::unique_ptr<ros_utils::DirectSubscription>> subscriptions_;
};

}  // namespace trident::bridges
