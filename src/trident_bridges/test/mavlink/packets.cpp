// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "mavlink/packets.h"

#include "mavlink/checksum.h"
#include "trident_base/random_stream.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/message_table.h"
#include "trident_bridges/mavlink/packet_parser.h"

namespace trident::bridges::mavlink::testing {
namespace {

void append_checksum(std::vector<std::uint8_t>& packet, std::uint32_t id) {
  const std::uint16_t crc =
      checksum(find_message(id)->crc_extra, checksum(Bytes(packet).subspan(1)));
  packet.push_back(static_cast<std::uint8_t>(crc));
  packet.push_back(static_cast<std::uint8_t>(crc >> 8));
}

}  // namespace

Message attitude(float roll) {
  mavlink_attitude_t payload{};
  payload.roll = roll;
  payload.yawspeed = 0.125F;
  return pack(payload, {7, 1});
}

Message random_message(std::uint32_t type, std::uint64_t seed) {
  const Span<const MessageFacts> all = message_table();
  const MessageFacts& facts = all[type % all.size()];
  const RandomStream random(seed, facts.name);
  Message message;
  message.id = facts.id;
  message.source = {static_cast<std::uint8_t>(1 + random.bits(0, 1) % 255), 1};
  message.length = facts.max_length;
  for (std::size_t i = 0; i < facts.max_length; ++i) {
    message.payload[i] = static_cast<std::uint8_t>(random.bits(i, 0));
  }
  return message;
}

std::vector<std::uint8_t> packet_of(PacketWriter& writer, const Message& message) {
  const Bytes bytes = writer.write(message);
  return {bytes.begin(), bytes.end()};
}

std::vector<std::uint8_t> with_flags(const Message& message, std::uint8_t flags) {
  PacketWriter writer;
  std::vector<std::uint8_t> packet = packet_of(writer, message);
  packet.resize(packet.size() - kChecksumSize);
  packet[2] = flags;
  append_checksum(packet, message.id);
  return packet;
}

std::vector<std::uint8_t> mavlink1(const Message& message) {
  std::vector<std::uint8_t> packet{kStart1,
                                   find_message(message.id)->min_length,
                                   message.sequence,
                                   message.source.system,
                                   message.source.component,
                                   static_cast<std::uint8_t>(message.id)};
  packet.insert(packet.end(), message.payload.begin(),
                message.payload.begin() + find_message(message.id)->min_length);
  append_checksum(packet, message.id);
  return packet;
}

void append(std::vector<std::uint8_t>& bytes, const std::vector<std::uint8_t>& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

std::vector<Message> parse(const std::vector<std::uint8_t>& bytes) {
  PacketParser parser;
  parser.feed(bytes);
  std::vector<Message> messages;
  while (const auto packet = parser.next()) messages.push_back(to_message(*packet));
  return messages;
}

}  // namespace trident::bridges::mavlink::testing
