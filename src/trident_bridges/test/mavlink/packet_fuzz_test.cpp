// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What sanitizers watch: random bytes and mutated packets. TRIDENT_FUZZ_SCALE multiplies the 10^5
// random bytes and the 10^4 mutated packets.
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "mavlink/packets.h"
#include "trident_base/random_stream.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/message_json.h"
#include "trident_bridges/mavlink/packet_parser.h"
#include "trident_bridges/mavlink/signing.h"

namespace trident::bridges::mavlink {
namespace {

std::uint64_t scale() {
  const char* text = std::getenv("TRIDENT_FUZZ_SCALE");
  return text == nullptr ? 1 : std::strtoull(text, nullptr, 10);
}

/// Uses every byte of what the parser returns.
std::size_t use(PacketParser& parser, Signing& signing) {
  std::size_t packets = 0;
  while (const auto packet = parser.next()) {
    EXPECT_LE(packet->raw.size(), kMaxPacket);
    EXPECT_FALSE(to_json(to_message(*packet)).empty());
    target_of(*packet);
    signing.check(*packet);
    ++packets;
  }
  return packets;
}

TEST(PacketFuzz, GoodPacketsAreFoundBehindRandomBytes) {
  const RandomStream random(7, "bytes");
  PacketWriter writer;
  Signing signing({}, nullptr, 0);
  PacketParser parser(true);
  std::vector<std::uint8_t> block(997);
  std::uint64_t index = 0;
  for (std::uint64_t run = 0; run < 100 * scale(); ++run) {
    for (std::uint8_t& byte : block) {
      const std::uint64_t bits = random.bits(index++, 0);
      byte = bits % 16 == 0 ? kStart2 : static_cast<std::uint8_t>(bits >> 8);
    }
    parser.feed(block);
    use(parser, signing);
    // Behind a longest packet's length nothing of the random bytes is waited for any more.
    std::vector<std::uint8_t> good;
    for (int i = 0; i < 8; ++i)
      testing::append(good, testing::packet_of(writer, testing::attitude(1.0F)));
    parser.feed(good);
    std::size_t attitudes = 0;
    while (const auto packet = parser.next()) attitudes += packet->id == MAVLINK_MSG_ID_ATTITUDE;
    EXPECT_GE(attitudes, 1U) << "run " << run;
  }
}

TEST(PacketFuzz, MutatedPacketsAreReadOrSkippedAndTheNextOneIsRead) {
  const RandomStream random(8, "mutations");
  PacketWriter writer;
  Signing signing({}, nullptr, 0);
  const std::vector<std::uint8_t> good = testing::packet_of(writer, testing::attitude(3.0F));
  for (std::uint64_t run = 0; run < 10'000 * scale(); ++run) {
    const auto type = static_cast<std::uint32_t>(random.bits(run, 0));
    std::vector<std::uint8_t> bytes =
        testing::packet_of(writer, testing::random_message(type, run));
    const std::uint64_t changes = 1 + random.bits(run, 1) % 4;
    for (std::uint32_t i = 0; i < changes; ++i) {
      bytes[random.bits(run, 10 + i) % bytes.size()] =
          static_cast<std::uint8_t>(random.bits(run, 20 + i));
    }
    if (random.bits(run, 2) % 4 == 0) bytes.resize(random.bits(run, 3) % bytes.size());
    PacketParser parser(run % 2 == 0);
    parser.feed_datagram(bytes);
    use(parser, signing);
    parser.feed_datagram(good);
    EXPECT_EQ(use(parser, signing), 1U) << "run " << run;
  }
}

}  // namespace
}  // namespace trident::bridges::mavlink
