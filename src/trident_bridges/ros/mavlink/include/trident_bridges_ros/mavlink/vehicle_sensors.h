// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/NavSatFix.h>
#include <trident_msgs/GnssStatus.h>
#include <trident_msgs/WindReading.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trident_bridges/vehicle/telemetry.h"
#include "trident_bridges_ros/mavlink/static_frames.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_ros/refusals.h"

namespace trident::bridges {

/// What a vehicle's own sensors and its estimator publish, as its autopilot takes it.
class VehicleSensors {
 public:
  /// Where the odometry is, and what hears of it.
  struct Setup {
    std::string odometry;                ///< topic below the vehicle's namespace
    std::string imu;                     ///< the same
    const StaticFrames& frames;          ///< must outlive this
    ros_utils::Refusals& refusals;       ///< must outlive this
    std::function<void(SimTime)> moved;  ///< there is a newer state, with its stamp
  };
  /// Subscribes below `node`: the odometry, the IMU, `battery`, `fix`, `gnss_status` and
  /// `wind_reading`. It flies by odometry and battery alone; the others are for its clients.
  VehicleSensors(ros::NodeHandle& node, NodePollLoop& loop, Setup setup);

  /// Whether somebody publishes the odometry to this node.
  bool is_connected() const { return subscriptions_.front()->publishers() > 0; }
  const VehicleState& state() const { return state_; }                    ///< world
  const mavlink::VehicleReadings& readings() const { return readings_; }  ///< the newest
  const std::string& frame() const { return frame_; }                     ///< of the odometry
  const SE3& T_world_frame() const { return T_world_frame_; }             ///< of the same

 private:
  void on_odometry(const nav_msgs::Odometry& message);
  void on_battery(const sensor_msgs::BatteryState& message);
  void take_battery(SimTime now);
  void on_imu(const sensor_msgs::Imu& message);
  void on_fix(const sensor_msgs::NavSatFix& message);
  void on_gnss_status(const trident_msgs::GnssStatus& message);
  void on_wind(const trident_msgs::WindReading& message);
  template <class Message>
  void listen(ros::NodeHandle& node, NodePollLoop& loop, const std::string& topic,
              void (VehicleSensors::*handler)(const Message&));
  bool accept(const char* what, const std::string& problem);
  bool find_frame(const std::string& frame);

  Setup setup_;
  VehicleState state_;
  mavlink::VehicleReadings readings_;
  std::string frame_, topic_;
  SE3 T_world_frame_;
  ros::WallTime frame_wanted_;  // zero: not yet
  /// Counts from a later odometry on, so that it is the same one in each run.
  struct WaitingBattery {
    SimTime stamp;
    double charge, voltage_V, current_A;
  };
  std::vector<WaitingBattery> batteries_;
  mavlink::VibrationMeter vibration_;
  std::vector<std::unique_ptr<ros_utils::DirectSubscription>> subscriptions_;
};

}  // namespace trident::bridges
