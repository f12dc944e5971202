// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/motor_command_publisher.h"

#include <mav_msgs/Actuators.h>
#include <ros/serialization.h>

#include <cstring>

namespace trident::control {
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

MotorCommandPublisher::Command::Command(std::size_t rotor_count)
    : speeds(rotor_count, 0.0), bytes(frame_of_zeros(rotor_count)) {}

Span<const std::uint8_t> MotorCommandPublisher::Command::frame(std::uint32_t sequence) {
  std::memcpy(bytes.data() + kSequenceAt, &sequence, sizeof(sequence));
  std::memcpy(bytes.data() + kSecondsAt, &stamp.sec, sizeof(stamp.sec));
  std::memcpy(bytes.data() + kNanosecondsAt, &stamp.nsec, sizeof(stamp.nsec));
  std::memcpy(bytes.data() + kSpeedsAt, speeds.data(), speeds.size() * sizeof(double));
  return bytes;
}

boost::shared_ptr<void const> MotorCommandPublisher::Command::object() {
  const auto message = pool.take();
  message->header.stamp = stamp;
  message->angular_velocities = speeds;
  return message;
}

MotorCommandPublisher::MotorCommandPublisher(ros::NodeHandle& node, std::size_t rotor_count)
    : publisher_(node.advertise<mav_msgs::Actuators>("command/motor_speed", 1)),
      publication_(publisher_),
      command_(rotor_count) {}

void MotorCommandPublisher::publish(const ros::Time& stamp) {
  command_.stamp = stamp;
  publication_.send(command_);
}

}  // namespace trident::control
