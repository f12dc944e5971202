// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/rtu.h"

#include <gtest/gtest.h>

#include <random>

#include "bytes_of_text.h"

namespace trident::bridges::modbus {
namespace {

constexpr double kSilenceS = 0.004;

std::vector<std::uint8_t> framed(std::uint8_t unit, const std::string& pdu_hex) {
  const auto pdu = bytes_of(pdu_hex);
  std::vector<std::uint8_t> out;
  append_rtu_frame(unit, pdu, out);
  return out;
}

/// What the reader has at `now_s`, as "unit: pdu" each.
std::vector<std::string> frames_of(RtuFrameReader& reader, double now_s) {
  std::vector<std::string> result;
  while (const auto frame = reader.next(now_s)) {
    result.push_back(std::to_string(frame->unit) + ": " + hex_of(frame->pdu));
  }
  return result;
}

using Texts = std::vector<std::string>;

TEST(Rtu, TheChecksumIsThatOfTheSpecification) {
  const auto example = bytes_of("02 07");  // Modbus over Serial Line V1.02, section 6.2.2
  EXPECT_EQ(rtu_crc(example), 0x1241);
  EXPECT_EQ(hex_of(framed(1, "03 00 00 00 0A")), "01 03 00 00 00 0A C5 CD");
}

TEST(Rtu, SilenceIsThreeAndAHalfCharactersUpTo19200Baud) {
  EXPECT_DOUBLE_EQ(rtu_timing(9600).silence_s, 3.5 * 11 / 9600);
  EXPECT_DOUBLE_EQ(rtu_timing(19200).silence_s, 3.5 * 11 / 19200);
  EXPECT_DOUBLE_EQ(rtu_timing(115200).silence_s, 0.00175);
  EXPECT_DOUBLE_EQ(rtu_timing(9600).character_s, 11.0 / 9600);
}

TEST(Rtu, EveryKnownFrameIsTakenAtItsLastByte) {
  for (const char* const pdu :
       {"01 00 13 00 13", "06 00 01 00 03", "0F 00 13 00 0A 02 CD 01", "16 00 04 00 F2 00 25",
        "10 00 01 00 02 04 00 0A 01 02", "17 00 03 00 06 00 0E 00 03 06 00 FF 00 FF 00 FF",
        "2B 0E 01 00", "01 03 CD 6B 05", "03 06 02 2B 00 00 00 64", "0F 00 13 00 0A", "83 02",
        "17 0C 00 FE 0A CD 00 01 00 03 00 0D 00 FF", "2B 0E 01 01 00 00 01 00 02 41 42"}) {
    RtuFrameReader reader(kSilenceS, false);
    const auto bytes = framed(17, pdu);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      EXPECT_EQ(frames_of(reader, 1.0 + 0.001 * i), Texts()) << pdu;
      reader.feed(Bytes(bytes).subspan(i, 1), 1.0 + 0.001 * i);
    }
    EXPECT_EQ(frames_of(reader, 1.0 + 0.001 * bytes.size()), Texts{std::string("17: ") + pdu});
    EXPECT_EQ(reader.counts().noise_bytes, 0U);
  }
}

TEST(Rtu, AFrameOfUnknownLengthEndsWithTheSilence) {
  RtuFrameReader reader(kSilenceS, false);
  const auto bytes = framed(5, "64 01 02 03 04");
  reader.feed(bytes, 1.0);
  EXPECT_EQ(frames_of(reader, 1.0 + 0.9 * kSilenceS), Texts());
  ASSERT_TRUE(reader.deadline_s());
  EXPECT_DOUBLE_EQ(*reader.deadline_s(), 1.0 + kSilenceS);
  EXPECT_EQ(frames_of(reader, *reader.deadline_s()), Texts{"5: 64 01 02 03 04"});
  EXPECT_FALSE(reader.deadline_s());
}

TEST(Rtu, ASilenceWithinAFrameMakesItNoise) {
  RtuFrameReader reader(kSilenceS, false);
  const auto bytes = framed(1, "03 00 00 00 0A");
  reader.feed(Bytes(bytes).first(5), 1.0);
  reader.feed(Bytes(bytes).subspan(5), 1.0 + kSilenceS);
  EXPECT_EQ(frames_of(reader, 1.0 + kSilenceS), Texts());
  EXPECT_EQ(frames_of(reader, 2.0), Texts());
  EXPECT_EQ(reader.counts().bad_frames, 2U);
  EXPECT_EQ(reader.counts().noise_bytes, bytes.size());
}

TEST(Rtu, AWrongChecksumIsNoFrame) {
  RtuFrameReader reader(kSilenceS, false);
  auto bytes = framed(1, "03 00 00 00 0A");
  bytes[3] ^= 0x10;
  reader.feed(bytes, 1.0);
  EXPECT_EQ(frames_of(reader, 1.0 + kSilenceS), Texts());
  EXPECT_EQ(reader.counts().bad_frames, 1U);
}

TEST(Rtu, SomeBytesOfNoiseBeforeAFrameDoNotHarmIt) {
  for (std::size_t noise = 1; noise <= RtuFrameReader::kMaxNoise; ++noise) {
    RtuFrameReader reader(kSilenceS, false);
    std::vector<std::uint8_t> bytes(noise, 0xFF);
    const auto frame = framed(1, "03 00 00 00 0A");
    bytes.insert(bytes.end(), frame.begin(), frame.end());
    reader.feed(bytes, 1.0);
    EXPECT_EQ(frames_of(reader, 1.0 + kSilenceS), Texts{"1: 03 00 00 00 0A"}) << noise;
    EXPECT_EQ(reader.counts().noise_bytes, noise);
  }
}

TEST(Rtu, FramesThatAreReadLateInOneBlockAreCutApart) {
  RtuFrameReader reader(kSilenceS, false);
  auto bytes = framed(2, "03 00 6B 00 03");
  for (const auto& next : {framed(2, "03 06 02 2B 00 00 00 64"), framed(1, "06 00 01 00 03")}) {
    bytes.insert(bytes.end(), next.begin(), next.end());
  }
  reader.feed(bytes, 1.0);
  EXPECT_EQ(frames_of(reader, 1.0),
            (Texts{"2: 03 00 6B 00 03", "2: 03 06 02 2B 00 00 00 64", "1: 06 00 01 00 03"}));
}

TEST(Rtu, ItIsKnownWhetherAFrameIsARequestOrAResponse) {
  const auto kinds = [](const std::string& pdu) {
    RtuFrameReader reader(kSilenceS, false);
    const auto bytes = framed(2, pdu);
    reader.feed(bytes, 1.0);
    const auto frame = reader.next(1.0);
    return std::make_pair(frame->may_be_request, frame->may_be_response);
  };
  EXPECT_EQ(kinds("03 00 6B 00 03"), std::make_pair(true, false));
  EXPECT_EQ(kinds("03 06 02 2B 00 00 00 64"), std::make_pair(false, true));
  EXPECT_EQ(kinds("06 00 01 00 03"), std::make_pair(true, true));
  EXPECT_EQ(kinds("86 03"), std::make_pair(false, true));
}

TEST(Rtu, TheEchoOfWhatWasSentIsRemovedEvenWhereItLooksLikeTheResponse) {
  RtuFrameReader reader(kSilenceS, true);
  const auto sent = framed(1, "06 00 01 00 03");
  reader.expect_echo(sent);
  reader.feed(Bytes(sent).first(3), 1.0);
  EXPECT_EQ(frames_of(reader, 1.0), Texts());
  reader.feed(Bytes(sent).subspan(3), 1.001);
  EXPECT_EQ(frames_of(reader, 1.001), Texts());
  reader.feed(sent, 1.01);
  EXPECT_EQ(frames_of(reader, 1.01), Texts{"1: 06 00 01 00 03"});
  EXPECT_EQ(reader.counts().echoes, 1U);
}

TEST(Rtu, AnEchoThatDoesNotComeHidesNoResponse) {
  RtuFrameReader reader(kSilenceS, true);
  reader.expect_echo(framed(1, "03 00 6B 00 03"));
  reader.feed(framed(1, "83 02"), 1.0);
  EXPECT_EQ(frames_of(reader, 1.0), Texts{"1: 83 02"});
}

TEST(Rtu, ALineThatNeverFallsSilentTakesNoMemory) {
  RtuFrameReader reader(kSilenceS, false);
  std::mt19937_64 random(1);
  std::uint64_t fed = 0;
  for (int i = 0; i < 1000; ++i) {
    std::vector<std::uint8_t> block(random() % 300);
    for (auto& byte : block) byte = static_cast<std::uint8_t>(random());
    reader.feed(block, 1e-3 * i);
    fed += block.size();
    while (reader.next(1e-3 * i)) continue;
  }
  EXPECT_GT(reader.counts().noise_bytes, fed * 9 / 10);
}

}  // namespace
}  // namespace trident::bridges::modbus
