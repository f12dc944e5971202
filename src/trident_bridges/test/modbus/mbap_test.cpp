// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/mbap.h"

#include <gtest/gtest.h>

#include "bytes_of_text.h"

namespace trident::bridges::modbus {
namespace {

TEST(TcpFrames, AFrameIsHeaderUnitAndPdu) {
  const auto pdu = bytes_of("03 00 04 00 01");
  std::vector<std::uint8_t> out;
  append_tcp_frame({0x1501, 0xFF, pdu}, out);
  EXPECT_EQ(hex_of(out), "15 01 00 00 00 06 FF 03 00 04 00 01");
}

TEST(TcpFrames, AStreamYieldsTheSameFramesHoweverItIsCut) {
  std::vector<std::uint8_t> stream;
  for (int i = 0; i < 5; ++i) {
    const std::vector<std::uint8_t> pdu(static_cast<std::size_t>(1 + 60 * i), 0x42);
    append_tcp_frame({static_cast<std::uint16_t>(i), 7, pdu}, stream);
  }
  for (std::size_t block = 1; block <= stream.size(); ++block) {
    TcpFrameReader reader;
    std::vector<std::uint8_t> again;
    for (std::size_t at = 0; at < stream.size(); at += block) {
      reader.feed(Bytes(stream).subspan(at, std::min(block, stream.size() - at)));
      while (const auto frame = reader.next()) append_tcp_frame(*frame, again);
    }
    ASSERT_EQ(again, stream) << "blocks of " << block;
    ASSERT_EQ(reader.pending(), 0U);
  }
}

TEST(TcpFrames, AHeaderThatIsNoneEndsTheStream) {
  for (const char* const hex : {"00 01 00 01 00 06 01 03", "00 01 00 00 00 01 01 03",
                                "00 01 00 00 00 FF 01 03", "47 45 54 20 2F 20 48"}) {
    TcpFrameReader reader;
    const auto bytes = bytes_of(hex);
    reader.feed(bytes);
    EXPECT_FALSE(reader.next());
    EXPECT_NE(reader.problem().find("legal: "), std::string::npos) << reader.problem();
    std::vector<std::uint8_t> good;
    append_tcp_frame({1, 1, bytes}, good);
    reader.feed(good);
    EXPECT_FALSE(reader.next()) << "a broken stream has no beginning any more";
  }
}

TEST(TcpFrames, TheFramesBeforeABrokenHeaderCount) {
  TcpFrameReader reader;
  const auto bytes = bytes_of("00 01 00 00 00 02 01 2B FF FF FF FF FF FF FF");
  reader.feed(bytes);
  EXPECT_TRUE(reader.next());
  EXPECT_TRUE(reader.problem().empty());
  EXPECT_FALSE(reader.next());
  EXPECT_FALSE(reader.problem().empty());
}

}  // namespace
}  // namespace trident::bridges::modbus
