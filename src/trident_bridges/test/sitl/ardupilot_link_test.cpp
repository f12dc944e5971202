// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/sitl/ardupilot_link.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/random_stream.h"

namespace trident::bridges::sitl {
namespace {

using Datagram = std::vector<std::uint8_t>;

Datagram servo_packet(std::uint32_t count, std::uint16_t rate = 400, std::uint16_t magic = 18458,
                      int channels = 16) {
  Datagram out;
  const auto put = [&](std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  };
  put(magic, 2);
  put(rate, 2);
  put(count, 4);
  for (int i = 0; i < channels; ++i) put(1000U + static_cast<unsigned>(i), 2);
  return out;
}

Span<const std::uint8_t> span(const Datagram& data) { return {data.data(), data.size()}; }

std::string error_of(const Datagram& data) {
  try {
    parse_servo_packet(span(data));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

struct ArduPilotRig {
  std::vector<std::string> sent;
  ArduPilotLink link{true, [this](Span<const std::uint8_t> block) {
                       sent.emplace_back(block.begin(), block.end());
                     }};
  void servo(std::uint32_t count) { link.received(span(servo_packet(count))); }
  void step(std::int64_t ms) {
    JsonState state;
    state.stamp = {ms * 1'000'000};
    link.send_state(state);
  }
};

TEST(ServoPacket, HasSixteenOrThirtyTwoChannels) {
  const ServoPacket packet = parse_servo_packet(span(servo_packet(70000)));
  EXPECT_EQ(packet.frame_rate_hz, 400);
  EXPECT_EQ(packet.frame_count, 70000U);
  EXPECT_EQ(packet.channels, 16U);
  EXPECT_EQ(packet.pwm[15], 1015);
  EXPECT_EQ(parse_servo_packet(span(servo_packet(1, 400, 29569, 32))).pwm[31], 1031);
}

TEST(ServoPacket, ABadOneIsRefusedWithFieldValueAndRange) {
  EXPECT_EQ(error_of(servo_packet(1, 400, 1234)),
            "servo packet: magic is 1234, legal: 18458 or 29569");
  EXPECT_EQ(error_of(servo_packet(1, 0)), "servo packet: frame_rate is 0, legal: 1 to 65535");
  EXPECT_EQ(error_of(servo_packet(1, 400, 29569)),
            "servo packet: length is 40 bytes, legal with magic 29569: 72");
  EXPECT_EQ(error_of({1, 2, 3}), "servo packet: length is 3 bytes, legal: 40 or 72");
}

TEST(ServoPacket, RandomBytesAreRefusedOrHaveChannels) {
  const RandomStream random(1, "servo packets");
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Datagram bytes(random.bits(i, 0) % 80);
    for (std::size_t k = 0; k < bytes.size(); ++k) {
      bytes[k] = static_cast<std::uint8_t>(random.bits(i, static_cast<std::uint32_t>(k + 1)));
    }
    if (i % 2 == 0 && bytes.size() >= 2) bytes[0] = 18458 & 0xFF, bytes[1] = 18458 >> 8;
    try {
      EXPECT_EQ(parse_servo_packet(span(bytes)).channels, 16U);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("legal"), std::string::npos);
    }
  }
}

TEST(ArduPilotLink, EachPacketIsOneStepAndOneAnswer) {
  ArduPilotRig rig;
  EXPECT_TRUE(rig.link.is_awaited());
  rig.servo(0);
  EXPECT_FALSE(rig.link.is_awaited());
  rig.step(2);
  EXPECT_TRUE(rig.link.is_awaited());
  rig.servo(1);
  rig.step(4);
  ASSERT_EQ(rig.sent.size(), 2U);
  EXPECT_EQ(rig.sent[1].front(), '\n');
  EXPECT_EQ(rig.sent[1].back(), '\n');
  EXPECT_NE(rig.sent[1].find("{\"timestamp\":0.004000000,\"imu\":{\"gyro\":[0,0,0]"),
            std::string::npos);
}

TEST(ArduPilotLink, APacketThatComesTwiceGetsItsAnswerAgainAndNoStep) {
  ArduPilotRig rig;
  rig.servo(5);
  rig.servo(5);
  EXPECT_TRUE(rig.sent.empty());
  rig.step(2);
  rig.servo(5);
  ASSERT_EQ(rig.sent.size(), 2U);
  EXPECT_EQ(rig.sent[0], rig.sent[1]);
  EXPECT_TRUE(rig.link.is_awaited());
  EXPECT_EQ(rig.link.repeats(), 2U);
}

TEST(ArduPilotLink, ACountThatBeginsAgainIsANewProgram) {
  ArduPilotRig rig;
  rig.servo(100);
  rig.step(2);
  rig.servo(0);
  EXPECT_EQ(rig.link.joins(), 2U);
  EXPECT_FALSE(rig.link.is_awaited());
}

TEST(ArduPilotLink, TimeGrowsThoughTheWorldsReturns) {
  ArduPilotRig rig;
  rig.servo(0);
  rig.step(500);
  rig.servo(1);
  rig.step(2);
  EXPECT_NE(rig.sent[1].find("\"timestamp\":0.501000000"), std::string::npos);
}

TEST(ArduPilotLink, OneThatWasGivenUpIsWaitedForAgainFromItsNextPacketOn) {
  ArduPilotRig rig;
  rig.servo(0);
  rig.step(2);
  rig.link.give_up();
  EXPECT_FALSE(rig.link.is_awaited());
  rig.servo(1);
  rig.step(4);
  EXPECT_TRUE(rig.link.is_awaited());
}

}  // namespace
}  // namespace trident::bridges::sitl
