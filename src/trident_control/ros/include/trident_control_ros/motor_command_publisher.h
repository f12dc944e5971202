// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mav_msgs/Actuators.h>
#include <ros/ros.h>

#include <cstdint>
#include <vector>

#include "trident_base/span.h"
#include "trident_ros/direct_message.h"
#include "trident_ros/direct_publication.h"

namespace trident::control {

/// Publishes mav_msgs/Actuators on `command/motor_speed`: to other processes one serialised
/// message, in which only sequence number, stamp and speeds change; to this one an object.
class MotorCommandPublisher {
 public:
  /// Advertises the motor speeds below `node`'s namespace; every message has `rotor_count` of them.
  MotorCommandPublisher(ros::NodeHandle& node, std::size_t rotor_count);

  /// Where the next command is to be written [rad/s].
  Span<double> rotor_speeds() { return command_.speeds; }
  /// Calls must not overlap.
  void publish(const ros::Time& stamp);

 private:
  struct Command : ros_utils::DirectMessage {
    explicit Command(std::size_t rotor_count);
    Span<const std::uint8_t> frame(std::uint32_t sequence) override;
    boost::shared_ptr<void const> object() override;
    const std::type_info& type() const override { return typeid(mav_msgs::Actuators); }

    ros::Time stamp;
    std::vector<double> speeds;
    std::vector<std::uint8_t> bytes;
    ros_utils::MessagePool<mav_msgs::Actuators> pool;
  };

  ros::Publisher publisher_;
  ros_utils::DirectPublication publication_;
  Command command_;
};

}  // namespace trident::control
