// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/QuaternionStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <ros/ros.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/TimeReference.h>

#include <functional>
#include <string>

#include "trident_bridges/nmea/receive/events.h"
#include "trident_bridges_ros/node_publisher.h"

namespace trident::bridges {

/// How fixes become messages.
struct NavsatOutputParams {
  std::string frame_id = "gps";      ///< of all messages
  std::string time_source;           ///< of time_reference; "": frame_id
  bool uses_gnss_time = false;       ///< stamps fixes with the time of the receiver
  bool has_compass_heading = false;  ///< the yaw is the compass' angle, as upstream has it
  bool shows_no_fix = false;         ///< also publishes without a fix, NaN, as upstream does
};

/// Publishes what satellite receivers and compasses say on `fix`, `vel`, `heading` and
/// `time_reference`, as nmea_navsat_driver does.
class NavsatOutput : public nmea::ReceiverSink {
 public:
  /// Advertises the topics below `node`'s namespace.
  NavsatOutput(ros::NodeHandle node, const NavsatOutputParams& params);

  /// Stamp and frame of what is read next, in place of now and the parameter's.
  void set_origin(const ros::Time& stamp, const std::string& frame_id);
  /// What is read next is stamped with the time it is read.
  void set_now() { stamp_ = ros::Time::now(); }

  void on_fix(const nmea::NavsatFix& fix) override;
  void on_velocity(const nmea::GroundVelocity& velocity) override;
  void on_time(std::int64_t unix_ns) override;
  void on_heading(double heading_rad) override;

 protected:
  const ros::Time& stamp() const { return stamp_; }          ///< of what is read now
  const std::string& frame_id() const { return frame_id_; }  ///< of what is read now

 private:
  NavsatOutputParams params_;
  std::string frame_id_;
  ros::Time stamp_;
  NodePublisher<sensor_msgs::NavSatFix> fix_;
  NodePublisher<geometry_msgs::TwistStamped> velocity_;
  NodePublisher<geometry_msgs::QuaternionStamped> heading_;
  NodePublisher<sensor_msgs::TimeReference> time_;
};

}  // namespace trident::bridges
