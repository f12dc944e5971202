// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mavros_msgs/SysStatus.h>
#include <ros/ros.h>
#include <sensor_msgs/BatteryState.h>

#include <memory>
#include <string>
#include <vector>

#include "core/plugin.h"

namespace trident::mavros {

/// Batteries, sensors and diagnostics of the vehicle: a part of the plugin sys_status.
class VehicleHealth {
 public:
  /// Advertises its topics. `hub` must outlive it.
  explicit VehicleHealth(Hub& hub);

 private:
  struct Sensors {
    bool are_known = false;
    std::uint32_t bad = 0;  // enabled and not healthy: MAV_SYS_STATUS_SENSOR
  };
  void on_status(const Message& message);
  void on_battery(const Message& message);
  void publish_battery(double voltage_mV, int current_cA, int percent,
                       const std::vector<float>& cells, const std::string& location);
  void publish_diagnostics();

  Hub& hub_;
  ros::Publisher diagnostics_;
  std::unique_ptr<bridges::NodePublisher<sensor_msgs::BatteryState>> battery_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::SysStatus>> status_;
  bool has_battery_status_ = false;
  double voltage_V_ = 0.0;
  Sensors sensors_;
};

}  // namespace trident::mavros
