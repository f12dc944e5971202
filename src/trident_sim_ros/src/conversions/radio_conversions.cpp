// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "radio_conversions.h"

#include "conversions.h"
#include "trident_sim_ros/output_topic.h"

namespace trident::sim {
namespace {

void convert(const LinkStatusSample& sample, trident_msgs::LinkStatus& message) {
  const RadioLink& link = sample.link;
  message.source = link.source;
  message.destination = link.destination;
  message.distance = static_cast<float>(link.distance_m);
  message.rssi_dbm = static_cast<float>(link.rssi_dbm);
  message.snr_db = static_cast<float>(link.snr_db);
  message.mcs = static_cast<std::int8_t>(link.mcs);
  message.rate_bps = static_cast<float>(link.rate_bit_s);
  message.packet_error_rate = static_cast<float>(link.packet_error_rate);
  message.latency = static_cast<float>(sample.latency_s);
  message.jitter = static_cast<float>(sample.jitter_s);
  message.goodput_bps = static_cast<float>(sample.goodput_bit_s);
  message.queue_bytes = static_cast<float>(link.queue_bytes);
  message.airtime_share = static_cast<float>(sample.airtime_share);
  message.sent = link.sent;
  message.delivered = link.delivered;
  // Refused by a full queue, lost after all tries, expired before it was sent.
  message.dropped_queue = link.refused;
  message.dropped_air = link.lost;
  message.expired = link.expired;
  message.up = link.is_up ? 1 : 0;
  message.line_of_sight = link.has_line_of_sight ? 1 : 0;
  message.route = sample.route;
}

}  // namespace

void convert(const RadioPacketSample& sample, trident_msgs::RadioPacket& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.source = sample.source;
  message.destination = sample.destination;
  message.topic = sample.topic;
  message.qos = sample.qos;
  message.priority = sample.priority;
  message.deadline = ros::Duration(sample.deadline_s);
  message.id = sample.id;
  message.data.assign(sample.data.begin(), sample.data.end());
}

void convert(const LinkStatusArraySample& sample, trident_msgs::LinkStatusArray& message) {
  message.header.stamp = to_ros(sample.stamp);
  message.links.resize(sample.links.size());
  for (std::size_t i = 0; i < sample.links.size(); ++i) {
    message.links[i].header = message.header;
    convert(sample.links[i], message.links[i]);
  }
  message.heard.resize(sample.heard.size());
  for (std::size_t i = 0; i < sample.heard.size(); ++i) {
    message.heard[i].topic = sample.heard[i].topic;
    message.heard[i].messages = sample.heard[i].messages;
  }
}

RadioPacketSample from_packet(const trident_msgs::RadioPacket& message) {
  RadioPacketSample sample;
  sample.destination = message.destination;
  sample.topic = message.topic;
  sample.qos = message.qos;
  sample.priority = message.priority;
  sample.deadline_s = message.deadline.toSec();
  sample.id = message.id;
  sample.data.assign(message.data.begin(), message.data.end());
  return sample;
}

namespace {

const OutputTopicRegistrar<RadioPacketSample, trident_msgs::RadioPacket> kRadioPacketTopic;
const OutputTopicRegistrar<LinkStatusArraySample, trident_msgs::LinkStatusArray> kLinkStatusTopic;

}  // namespace
}  // namespace trident::sim
