// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/packet_parser.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "mavlink/packets.h"
#include "trident_base/random_stream.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/message_table.h"
#include "trident_bridges/mavlink/packet_writer.h"
#include "trident_bridges/mavlink/sequence_tracker.h"

namespace trident::bridges::mavlink {
namespace {

using testing::append;
using testing::attitude;
using testing::packet_of;
using testing::parse;
using testing::random_message;

TEST(MessageTable, IdsNamesAndFieldsBelongTogether) {
  std::uint32_t last = 0;
  ASSERT_GT(message_table().size(), 300U);
  for (const MessageFacts& facts : message_table()) {
    EXPECT_TRUE(facts.id > last || facts.id == 0) << facts.name;
    last = facts.id;
    EXPECT_EQ(find_message(facts.id), &facts);
    EXPECT_EQ(find_message(facts.name), &facts);
    EXPECT_FALSE(facts.fields.empty()) << facts.name;
  }
  EXPECT_EQ(find_message(MAVLINK_MSG_ID_AUTOPILOT_VERSION)->name, "AUTOPILOT_VERSION");
  EXPECT_EQ(find_message(13U), nullptr);
  EXPECT_EQ(find_message(60'000U), nullptr);
}

// CRC_EXTRA of names, types and order of fields, as published for the common dialect.
TEST(MessageTable, MessagesAddedToTheDialectHaveTheirPublishedChecksums) {
  const std::vector<std::pair<std::uint32_t, int>> published{{290, 251}, {291, 10},  {300, 217},
                                                             {334, 72},  {397, 182}, {400, 110},
                                                             {410, 160}, {435, 134}, {436, 193}};
  for (const auto& [id, crc_extra] : published) {
    ASSERT_NE(find_message(id), nullptr) << id;
    EXPECT_EQ(find_message(id)->crc_extra, crc_extra) << id;
  }
}

TEST(PacketParser, APacketIsReadAsItWasWritten) {
  PacketWriter writer;
  writer.write(attitude(0.1F));
  const std::vector<std::uint8_t> bytes = packet_of(writer, attitude(0.25F));
  PacketParser parser;
  parser.feed(bytes);
  const auto packet = parser.next();
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->sequence, 1);
  EXPECT_EQ(packet->source, (Address{7, 1}));
  EXPECT_EQ(packet->raw.size(), bytes.size());
  const Message message = to_message(*packet);
  ASSERT_TRUE(is<mavlink_attitude_t>(message));
  EXPECT_EQ(unpack<mavlink_attitude_t>(message).roll, 0.25F);
  EXPECT_FALSE(parser.next());
}

TEST(PacketParser, AStreamMayBeCutAnywhere) {
  PacketWriter writer;
  std::vector<std::uint8_t> bytes;
  const RandomStream random(1, "cut");
  for (std::uint32_t i = 0; i < 300; ++i) append(bytes, packet_of(writer, random_message(i, 1)));
  for (std::uint64_t run = 0; run < 20; ++run) {
    PacketParser parser;
    std::uint64_t count = 0;
    for (std::size_t at = 0, piece = 0; at < bytes.size(); ++piece) {
      const std::size_t longest = run < 10 ? 20 : 700;
      const std::size_t size = std::min<std::size_t>(
          bytes.size() - at, 1 + random.bits(piece, static_cast<std::uint32_t>(run)) % longest);
      // A copy of its own size, so that a sanitizer sees what is read beyond it.
      const std::vector<std::uint8_t> block(bytes.begin() + at, bytes.begin() + at + size);
      parser.feed(block);
      while (parser.next()) ++count;
      at += size;
    }
    EXPECT_EQ(count, 300U);
    EXPECT_EQ(parser.counts().skipped_bytes, 0U);
    EXPECT_EQ(parser.counts().bad_checksum, 0U);
  }
}

TEST(PacketParser, ABadPacketCostsNoGoodOneBehindIt) {
  PacketWriter writer;
  std::vector<std::uint8_t> bad = packet_of(writer, attitude(1.0F));
  const std::vector<std::uint8_t> good = packet_of(writer, attitude(2.0F));
  for (std::size_t i = 1; i < bad.size(); ++i) {
    std::vector<std::uint8_t> bytes = bad;
    bytes[i] ^= 0x10;
    append(bytes, good);
    append(bytes, good);
    const std::vector<Message> messages = parse(bytes);
    ASSERT_FALSE(messages.empty()) << "byte " << i;
    EXPECT_EQ(unpack<mavlink_attitude_t>(messages.back()).roll, 2.0F) << "byte " << i;
    EXPECT_GE(messages.size(), i == 1 ? 1U : 2U) << "byte " << i;
  }
}

TEST(PacketParser, ADatagramThatEndsEarlyIsSkipped) {
  PacketWriter writer;
  const std::vector<std::uint8_t> bytes = packet_of(writer, attitude(1.0F));
  PacketParser parser;
  parser.feed_datagram(Bytes(bytes).first(bytes.size() - 1));
  EXPECT_FALSE(parser.next());
  parser.feed_datagram(bytes);
  EXPECT_TRUE(parser.next());
  EXPECT_EQ(parser.counts().skipped_bytes, bytes.size() - 1);
}

TEST(PacketParser, UnknownMessagesAreHandedOnAndCounted) {
  PacketWriter writer;
  std::vector<std::uint8_t> bytes = packet_of(writer, attitude(1.0F));
  bytes[9] = 0xFA;  // highest byte of the id
  append(bytes, packet_of(writer, attitude(2.0F)));
  PacketParser parser;
  parser.feed(bytes);
  const auto unknown = parser.next();
  ASSERT_TRUE(unknown);
  EXPECT_FALSE(unknown->is_known);
  EXPECT_EQ(target_of(*unknown), (Address{0, 0}));
  ASSERT_TRUE(parser.next());
  EXPECT_EQ(parser.counts().unknown, 1U);
}

TEST(PacketParser, UnknownIncompatibilityFlagsDropAPacketWhole) {
  const std::vector<std::uint8_t> bytes = testing::with_flags(attitude(1.0F), 0x02);
  PacketParser parser;
  parser.feed(bytes);
  EXPECT_FALSE(parser.next());
  EXPECT_EQ(parser.counts().unknown_flags, 1U);
  EXPECT_EQ(parser.counts().skipped_bytes, 0U);
}

TEST(PacketParser, MavlinkOneIsReadWhereItIsAccepted) {
  const std::vector<std::uint8_t> bytes = testing::mavlink1(attitude(0.5F));
  PacketParser lenient(true), strict;
  lenient.feed(bytes);
  strict.feed(bytes);
  const auto packet = lenient.next();
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->version, 1);
  EXPECT_EQ(unpack<mavlink_attitude_t>(to_message(*packet)).roll, 0.5F);
  EXPECT_FALSE(strict.next());
  EXPECT_EQ(strict.counts().mavlink1, 1U);
}

TEST(PacketParser, ZerosAtTheEndOfAPayloadAreNotSent) {
  PacketWriter writer;
  mavlink_attitude_t payload{};
  EXPECT_EQ(packet_of(writer, pack(payload, {1, 1})).size(), kHeader2 + 1 + kChecksumSize);
  payload.pitchspeed = 1.0F;
  const std::vector<Message> messages = parse(packet_of(writer, pack(payload, {1, 1})));
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(unpack<mavlink_attitude_t>(messages[0]).pitchspeed, 1.0F);
  EXPECT_EQ(unpack<mavlink_attitude_t>(messages[0]).yawspeed, 0.0F);
}

TEST(PacketParser, TheTargetOfAPacketIsThatOfItsFields) {
  PacketWriter writer;
  mavlink_command_long_t command{};
  command.target_system = 3;
  command.target_component = 1;
  PacketParser parser;
  std::vector<std::uint8_t> bytes = packet_of(writer, pack(command, {255, 190}));
  append(bytes, packet_of(writer, attitude(1.0F)));
  parser.feed(bytes);
  EXPECT_EQ(target_of(*parser.next()), (Address{3, 1}));
  EXPECT_EQ(target_of(*parser.next()), (Address{0, 0}));
}

TEST(SequenceTracker, GapsAreLostPackets) {
  SequenceTracker tracker;
  for (const int sequence : {250, 251, 254, 255, 0, 2}) {
    tracker.note({1, 1}, static_cast<std::uint8_t>(sequence));
  }
  tracker.note({2, 1}, 9);
  EXPECT_EQ(tracker.counts().at({1, 1}).received, 6U);
  EXPECT_EQ(tracker.counts().at({1, 1}).lost, 3U);
  EXPECT_EQ(tracker.counts().at({2, 1}).lost, 0U);
}

TEST(SequenceTracker, LatePacketsAreNotLostAndARestartIsNoLoss) {
  SequenceTracker tracker;
  for (const int sequence : {100, 102, 101, 103, 0, 1}) {
    tracker.note({1, 1}, static_cast<std::uint8_t>(sequence));
  }
  EXPECT_EQ(tracker.counts().at({1, 1}).lost, 0U);
  EXPECT_EQ(tracker.counts().at({1, 1}).reordered, 1U);
}

}  // namespace
}  // namespace trident::bridges::mavlink
