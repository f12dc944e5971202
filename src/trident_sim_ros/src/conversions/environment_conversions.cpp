// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "environment_conversions.h"

#include "conversions.h"
#include "trident_sim_ros/output_topic.h"

namespace trident::sim {

void convert(const EnvironmentSample& sample, trident_msgs::EnvironmentState& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = "world";
  message.yaml = sample.yaml;
}

void convert(const WindReadingSample& sample, trident_msgs::WindReading& message) {
  using trident_msgs::WindReading;
  message.header.stamp = to_ros(sample.stamp);
  message.header.frame_id = sample.frame;
  message.reference =
      static_cast<std::uint8_t>(sample.is_true ? WindReading::TRUE : WindReading::RELATIVE);
  message.speed = sample.speed_m_s;
  message.angle = sample.angle_rad;
}

void convert(const NumberSample& sample, std_msgs::Float64& message) {
  message.data = sample.value;
}

void convert(const FlagSample& sample, std_msgs::Bool& message) {
  message.data = sample.value ? 1 : 0;
}

namespace {

const OutputTopicRegistrar<EnvironmentSample, trident_msgs::EnvironmentState> kEnvironmentTopic(
    latched_topic());
const OutputTopicRegistrar<WindReadingSample, trident_msgs::WindReading> kWindReadingTopic;
const OutputTopicRegistrar<NumberSample, std_msgs::Float64> kNumberTopic;
const OutputTopicRegistrar<FlagSample, std_msgs::Bool> kFlagTopic;

}  // namespace
}  // namespace trident::sim
