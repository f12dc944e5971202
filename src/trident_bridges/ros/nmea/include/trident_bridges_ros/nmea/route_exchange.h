// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <std_msgs/Float64.h>

#include <memory>
#include <string>
#include <vector>

#include "trident_bridges/nmea/send/guidance_talker.h"
#include "trident_bridges_ros/nmea/instrument_output.h"
#include "trident_bridges_ros/nmea/local_frame.h"
#include "trident_bridges_ros/nmea/nmea_node_params.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_ros/refusals.h"

namespace trident::bridges {

/// Routes and steering between sentences and a vehicle's topics: what a route planner sends becomes
/// `command/heading` [rad] and `command/path` in the odometry's frame, where that is wanted; the
/// vehicle's own path becomes WPL, RTE, APB and the rest, where their rates ask for it.
class RouteExchange {
 public:
  /// Subscribes and advertises below `node`'s namespace. The references outlive the exchange.
  RouteExchange(ros::NodeHandle& node, NodePollLoop& loop, const NmeaNodeParams& params,
                nmea::SentenceSender& sender, const UtcClock& clock, ros_utils::Refusals& refusals);

  /// What the output calls; empty where the node does not steer.
  AutopilotHooks autopilot();
  /// A fix: sets the frame's origin, unless it is known.
  void on_fix(const nmea::RoutePlace& place, double altitude_m);
  /// Where the odometry has the vehicle, in its frame [m].
  void on_position(SimTime stamp, const std::string& frame_id, const Eigen::Vector2d& p_frame,
                   const nmea::GroundVelocity& velocity);

 private:
  void steer(const nmea::SteeringEvent& steering);
  void follow(const std::vector<nmea::RoutePlace>& places);
  void on_path(const nav_msgs::Path& path);
  void make_route();

  bool steers_;
  LocalFrame frame_;
  ros_utils::Refusals& refusals_;
  nmea::GuidanceTalker guidance_;
  ros::Publisher heading_, path_;
  std::string frame_id_;                            ///< of the odometry
  std::optional<Eigen::Vector2d> p_frame_vehicle_;  ///< the newest
  std::vector<Eigen::Vector2d> p_frame_route_;      ///< of the vehicle's path, not yet on the earth
  std::unique_ptr<ros_utils::DirectSubscription> subscription_;
};

}  // namespace trident::bridges
