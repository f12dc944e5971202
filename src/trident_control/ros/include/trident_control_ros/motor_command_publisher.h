// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <vector>

#include "trident_base/span.h"
#include "trident_ros/direct_publication.h"

namespace trident {

/// Publishes mav_msgs/Actuators on `command/motor_speed`: one serialised message, in which only
/// sequence number, stamp and speeds change.
class MotorCommandPublisher {
 public:
  MotorCommandPublisher(ros::NodeHandle& node, std::size_t rotor_count);

  /// Where the next command is to be written [rad/s].
  Span<double> rotor_speeds() { return speeds_; }
  /// Calls must not overlap.
  void publish(const ros::Time& stamp);

 private:
  ros::Publisher publisher_;
  DirectPublication publication_;
  std::vector<double> speeds_;
  std::vector<std::uint8_t> frame_;
};

}  // namespace trident
