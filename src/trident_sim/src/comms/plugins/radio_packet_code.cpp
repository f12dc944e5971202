// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Four bytes that say what it is, qos, id (8 bytes, the lowest first), length of the topic (2
// bytes), topic, data.
#include "comms/plugins/radio_packet_code.h"

#include <cstdint>
#include <string_view>

#include "comms/wire.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

constexpr std::string_view kMark = "TRP1";

}  // namespace

std::string encode_packet(const RadioPacketSample& packet) {
  const std::size_t bytes = packet.topic.size() + packet.data.size();
  if (bytes > kMaxPacketBytes) {
    throw Error("a packet has " + std::to_string(bytes) + " bytes with its topic, legal: at most " +
                std::to_string(kMaxPacketBytes));
  }
  std::string result(kMark);
  wire::put(packet.qos, &result);
  wire::put(packet.id, &result);
  wire::put(static_cast<std::uint16_t>(packet.topic.size()), &result);
  return result + packet.topic + packet.data;
}

void decode_packet(const std::string& bytes, RadioPacketSample* packet) {
  wire::Fields fields(bytes);
  const bool is_packet = fields.text(kMark.size()) == kMark;
  packet->qos = fields.get<std::uint8_t>();
  packet->id = fields.get<std::uint64_t>();
  packet->topic = fields.text(fields.get<std::uint16_t>());
  packet->data = fields.rest();
  if (is_packet && fields.is_whole()) return;
  packet->qos = 0;
  packet->id = 0;
  packet->topic.clear();
  packet->data = bytes;
}

}  // namespace trident::sim
