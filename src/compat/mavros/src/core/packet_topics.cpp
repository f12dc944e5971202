// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/packet_topics.h"

#include <algorithm>
#include <cstring>

namespace trident::mavros {
namespace {

using bridges::mavlink::kChecksumSize;
using bridges::mavlink::kHeader1;
using bridges::mavlink::kHeader2;
using bridges::mavlink::kSignatureSize;
using bridges::mavlink::kStart1;
using bridges::mavlink::kStart2;

constexpr std::size_t kWord = sizeof(std::uint64_t);

std::uint16_t checksum_of(const Packet& packet) {
  const std::size_t header = packet.version == 2 ? kHeader2 : kHeader1;
  const std::size_t at = header + packet.payload.size();
  return static_cast<std::uint16_t>(packet.raw[at] | packet.raw[at + 1] << 8U);
}

void append_header(const mavros_msgs::Mavlink& m, std::vector<std::uint8_t>& packet) {
  const auto byte = [](std::uint32_t value, unsigned shift) {
    return static_cast<std::uint8_t>(value >> shift & 0xFFU);
  };
  if (m.magic == kStart1) {
    packet.assign({m.magic, m.len, m.seq, m.sysid, m.compid, byte(m.msgid, 0)});
    return;
  }
  packet.assign({m.magic, m.len, m.incompat_flags, m.compat_flags, m.seq, m.sysid, m.compid,
                 byte(m.msgid, 0), byte(m.msgid, 8), byte(m.msgid, 16)});
}

}  // namespace

void to_ros(const Packet& packet, mavros_msgs::Mavlink& message) {
  const bool is_2 = packet.version == 2;
  message.header.stamp = ros::Time::now();
  message.framing_status = mavros_msgs::Mavlink::FRAMING_OK;
  message.magic = is_2 ? kStart2 : kStart1;
  message.len = static_cast<std::uint8_t>(packet.payload.size());
  message.incompat_flags = is_2 ? packet.raw[2] : 0;
  message.compat_flags = is_2 ? packet.raw[3] : 0;
  message.seq = packet.sequence;
  message.sysid = packet.source.system;
  message.compid = packet.source.component;
  message.msgid = packet.id;
  message.checksum = checksum_of(packet);
  message.payload64.assign((packet.payload.size() + kWord - 1) / kWord, 0);
  std::memcpy(message.payload64.data(), packet.payload.data(), packet.payload.size());
  const std::size_t signature = packet.is_signed ? kSignatureSize : 0;
  message.signature.assign(packet.raw.end() - signature, packet.raw.end());
}

void to_packet(const mavros_msgs::Mavlink& message, std::vector<std::uint8_t>& packet) {
  packet.clear();
  const bool is_known = message.magic == kStart1 || message.magic == kStart2;
  if (!is_known || message.payload64.size() * kWord < message.len) return;
  append_header(message, packet);
  const std::size_t header = packet.size();
  packet.resize(header + message.len);
  std::memcpy(packet.data() + header, message.payload64.data(), message.len);
  packet.push_back(static_cast<std::uint8_t>(message.checksum & 0xFFU));
  packet.push_back(static_cast<std::uint8_t>(message.checksum >> 8U));
  packet.insert(packet.end(), message.signature.begin(), message.signature.end());
}

PacketTopics::PacketTopics(const ros::NodeHandle& node, VehicleSide& vehicle,
                           bridges::NodePollLoop& loop)
    : node_(node), from_(node_, "mavlink/from") {
  vehicle.on_packet([this](const Packet& packet) {
    if (from_.subscribers() == 0) return;
    to_ros(packet, heard_);
    from_.publish(heard_);
  });
  constexpr std::uint32_t kQueue = 100;
  to_ = loop.subscribe<mavros_msgs::Mavlink>(node_, "mavlink/to", kQueue,
                                             [this, &vehicle](const mavros_msgs::Mavlink& message) {
                                               to_packet(message, asked_);
                                               if (!asked_.empty())
                                                 vehicle.send_packet(bridges::Bytes(asked_));
                                             });
}

}  // namespace trident::mavros
