// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/motor_command_publisher.h"

#include <mav_msgs/Actuators.h>
#include <ros/serialization.h>

#include <cstring>

namespace trident {
namespace {

// Byte offsets in a framed mav_msgs/Actuators whose frame_id and angles are empty: length, then
// header (seq, stamp, frame_id), angles, angular_velocities, normalized.
constexpr std::size_t kSequenceAt = 4;
constexpr std::size_t kSecondsAt = 8;
constexpr std::size_t kNanosecondsAt = 12;
constexpr std::size_t kSpeedsAt = 28;

std::vector<std::uint8_t> frame_of_zeros(std::size_t rotor_count) {
  mav_msgs::Actuators message;
  message.angular_velocities.resize(rotor_count, 0.0);
  const ros::SerializedMessage serialized = ros::serialization::serializeMessage(message);
  return {serialized.buf.get(), serialized.buf.get() + serialized.num_bytes};
}

}  // namespace

MotorCommandPublisher::MotorCommandPublisher(ros::NodeHandle& node, std::size_t rotor_count)
    : publisher_(node.advertise<mav_msgs::Actuators>("command/motor_speed", 1)),
      publication_(publisher_),
      speeds_(rotor_count, 0.0),
      frame_(frame_of_zeros(rotor_count)) {}

void MotorCommandPublisher::publish(const ros::Time& stamp) {
  const std::uint32_t sequence = publication_.next_sequence();
  std::memcpy(frame_.data() + kSequenceAt, &sequence, sizeof(sequence));
  std::memcpy(frame_.data() + kSecondsAt, &stamp.sec, sizeof(stamp.sec));
  std::memcpy(frame_.data() + kNanosecondsAt, &stamp.nsec, sizeof(stamp.nsec));
  std::memcpy(frame_.data() + kSpeedsAt, speeds_.data(), speeds_.size() * sizeof(double));
  publication_.send(frame_);
}

}  // namespace trident
