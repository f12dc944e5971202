// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Four bytes that say what it is, qos, id (8 bytes, the lowest first), length of the topic (2
// bytes), topic, data.
#include "comms/plugins/radio_packet_code.h"

#include <cstdint>

#include "trident_base/error.h"

namespace trident::sim {
namespace {

constexpr char kMark[] = "TRP1";
constexpr std::size_t kMarkBytes = 4, kIdBytes = 8, kLengthBytes = 2;
constexpr std::size_t kHeaderBytes = kMarkBytes + 1 + kIdBytes + kLengthBytes;

void put(std::uint64_t value, std::size_t bytes, std::string* to) {
  for (std::size_t i = 0; i < bytes; ++i) to->push_back(static_cast<char>(value >> (8 * i)));
}

std::uint64_t get(const std::string& from, std::size_t place, std::size_t bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    value |= std::uint64_t{static_cast<std::uint8_t>(from[place + i])} << (8 * i);
  }
  return value;
}

}  // namespace

std::string encode_packet(const RadioPacketSample& packet) {
  const std::size_t bytes = packet.topic.size() + packet.data.size();
  if (bytes > kMaxPacketBytes) {
    throw Error("a packet has " + std::to_string(bytes) + " bytes with its topic, legal: at most " +
                std::to_string(kMaxPacketBytes));
  }
  std::string result(kMark, kMarkBytes);
  put(packet.qos, 1, &result);
  put(packet.id, kIdBytes, &result);
  put(packet.topic.size(), kLengthBytes, &result);
  return result + packet.topic + packet.data;
}

void decode_packet(const std::string& bytes, RadioPacketSample* packet) {
  packet->topic.clear();
  packet->qos = 0;
  packet->id = 0;
  packet->data = bytes;
  if (bytes.size() < kHeaderBytes || bytes.compare(0, kMarkBytes, kMark) != 0) return;
  const std::size_t topic = get(bytes, kHeaderBytes - kLengthBytes, kLengthBytes);
  if (bytes.size() < kHeaderBytes + topic) return;
  packet->qos = static_cast<std::uint8_t>(bytes[kMarkBytes]);
  packet->id = get(bytes, kMarkBytes + 1, kIdBytes);
  packet->topic = bytes.substr(kHeaderBytes, topic);
  packet->data = bytes.substr(kHeaderBytes + topic);
}

}  // namespace trident::sim
