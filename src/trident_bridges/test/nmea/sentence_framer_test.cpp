// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/sentence_framer.h"

#include <gtest/gtest.h>

#include "nmea/sentence_log.h"
#include "trident_base/error.h"
#include "trident_base/random_stream.h"

namespace trident::bridges::nmea {
namespace {

using Texts = std::vector<std::string>;

const std::string kHeading = "$HEHDT,123.4,T";
const std::string kAis = "!AIVDM,1,1,,A,1P0001?P00000000000000000000,0";

TEST(SentenceFramer, FindsASentenceWithAndWithoutALineEnd) {
  EXPECT_EQ(framed(with_checksum(kHeading)).sentences, Texts{kHeading});
  const std::string line = with_checksum(kHeading);
  EXPECT_EQ(framed(line.substr(0, line.size() - 2)).sentences, Texts{kHeading});
  EXPECT_EQ(framed(line + with_checksum(kAis)).sentences, (Texts{kHeading, kAis}));
}

TEST(SentenceFramer, TakesALowerCaseChecksum) {
  EXPECT_EQ(framed("$HEHDT,123.4,T*2b\r\n").sentences, Texts{kHeading});
}

TEST(SentenceFramer, FindsTheSameHoweverTheStreamIsCut) {
  const std::string stream = "noise\x01" + with_checksum(kHeading) + "\xb5\x62$" +
                             with_checksum(kAis) + "$GPGGA,1" + with_checksum(kHeading);
  const SentenceLog whole = framed(stream);
  EXPECT_EQ(whole.sentences, (Texts{kHeading, kAis, kHeading}));
  for (std::size_t size = 1; size < 20; ++size) {
    SentenceLog log;
    SentenceFramer framer;
    for (std::size_t at = 0; at < stream.size(); at += size) {
      framer.feed(bytes_of(std::string_view(stream).substr(at, size)), log);
    }
    EXPECT_EQ(log.sentences, whole.sentences) << "in blocks of " << size;
    EXPECT_EQ(log.refusals, whole.refusals) << "in blocks of " << size;
  }
}

TEST(SentenceFramer, NamesAWrongChecksumAndTheRightOne) {
  const SentenceLog log = framed("$HEHDT,123.4,T*00\r\n");
  EXPECT_TRUE(log.sentences.empty());
  EXPECT_EQ(log.refusals, Texts{"wrong checksum: checksum is '00', legal: 2B"});
  EXPECT_EQ(log.refused_texts, Texts{"$HEHDT,123.4,T*00"});
  EXPECT_EQ(framed("$HEHDT,123.4,T*2\r\n").refusals,
            Texts{"wrong checksum: checksum is '2', legal: 2B"});
  EXPECT_EQ(framed("$HEHDT,123.4,T*xy\r\n").refusals,
            Texts{"wrong checksum: checksum is 'xy', legal: 2B"});
}

TEST(SentenceFramer, NeedsAChecksumUnlessItIsAllowedToBeAbsent) {
  EXPECT_EQ(framed(kHeading + "\r\n").refusals,
            Texts{"no checksum: checksum is '', legal: * and two hexadecimal digits"});
  FramerParams lenient;
  lenient.require_checksum = false;
  EXPECT_EQ(framed(kHeading + "\r\n", lenient).sentences, Texts{kHeading});
  EXPECT_EQ(framed(kHeading + "*00\r\n", lenient).refusals.size(), 1U);
}

TEST(SentenceFramer, AcceptsEightyTwoCharactersAndRefusesTheNextOne) {
  const std::string longest = "$GPTXT,01,01,02," + std::string(61, 'x');
  ASSERT_EQ(with_checksum(longest).size(), kMaxSentenceLength);
  EXPECT_EQ(framed(with_checksum(longest)).sentences, Texts{longest});
  const SentenceLog log = framed(with_checksum(longest + 'x') + with_checksum(kHeading));
  EXPECT_EQ(log.refusals, Texts{"too long: length is 83, legal: [0, 82]"});
  EXPECT_EQ(log.sentences, Texts{kHeading});
}

TEST(SentenceFramer, ReadsLongerOnesWhereTheyAreAllowed) {
  FramerParams params;
  params.max_length = 100;
  const std::string text = "$PUBX,00," + std::string(86, '1');
  ASSERT_EQ(with_checksum(text).size(), 100U);
  EXPECT_EQ(framed(with_checksum(text), params).sentences, Texts{text});
  EXPECT_EQ(framed(with_checksum(text + '1'), params).refusals.size(), 1U);
}

TEST(SentenceFramer, AnIllegalLengthIsRefusedWithItsRange) {
  for (const std::size_t length : {std::size_t{0}, std::size_t{81}, std::size_t{1025}}) {
    FramerParams params;
    params.max_length = length;
    EXPECT_THROW(SentenceFramer{params}, Error);
  }
}

TEST(SentenceFramer, AByteThatIsNoTextEndsASentence) {
  const SentenceLog log = framed("$HEHDT,12\x80" + with_checksum(kHeading));
  EXPECT_EQ(log.refusals, Texts{"not text: character is 128, legal: [32, 126]"});
  EXPECT_EQ(log.sentences, Texts{kHeading});
}

TEST(SentenceFramer, NoiseThatBeginsWithADollarIsSkippedAndCounted) {
  SentenceLog log;
  SentenceFramer framer;
  const std::string noise = "$\x01$ab,*!$$\\x!\x02";
  framer.feed(bytes_of(noise + with_checksum(kHeading)), log);
  EXPECT_TRUE(log.refusals.empty());
  EXPECT_EQ(log.sentences, Texts{kHeading});
  EXPECT_EQ(framer.counts().bytes, noise.size() + kHeading.size() + 5);
  EXPECT_GE(framer.counts().skipped, noise.size() - 3);
}

TEST(SentenceFramer, AnExclamationMarkIsTextUntilTheChecksumSaysOtherwise) {
  const std::string text = "$GPTXT,01,01,02,go!";
  EXPECT_EQ(framed(with_checksum(text)).sentences, Texts{text});
  EXPECT_EQ(framed("$GPTXT,01,01" + with_checksum(kAis)).sentences, Texts{kAis});
  EXPECT_EQ(framed("$GPTXT,01,01,02,lost" + std::string(50, 'x') + with_checksum(kAis)).sentences,
            Texts{kAis});
}

TEST(SentenceFramer, ReadsTagBlocks) {
  const std::string block = "s:station,c:1609459200*5F";
  const SentenceLog log =
      framed("\\" + block + "\\" + with_checksum(kAis) + with_checksum(kHeading));
  EXPECT_EQ(log.sentences, (Texts{kAis, kHeading}));
  EXPECT_EQ(log.tag_blocks[1], "");
  const SentenceLog plain = framed("\\g:1-2-34\\" + with_checksum(kAis));
  EXPECT_EQ(plain.tag_blocks, Texts{"g:1-2-34"});
  EXPECT_EQ(plain.sentences, Texts{kAis});
}

TEST(SentenceFramer, ATagBlockWithAWrongChecksumIsLeftOut) {
  const SentenceLog log = framed("\\s:station*00\\" + with_checksum(kAis));
  EXPECT_EQ(log.sentences, Texts{kAis});
  EXPECT_EQ(log.tag_blocks, Texts{""});
}

TEST(SentenceFramer, ADatagramEndsALine) {
  FramerParams params;
  params.require_checksum = false;
  SentenceLog log;
  SentenceFramer framer(params);
  framer.feed(bytes_of(kHeading), log);
  EXPECT_TRUE(log.sentences.empty());
  framer.finish(log);
  EXPECT_EQ(log.sentences, Texts{kHeading});
}

TEST(SentenceFramer, AfterAResetTheRestOfASentenceIsNoise) {
  SentenceLog log;
  SentenceFramer framer;
  framer.feed(bytes_of("$HEHDT,12"), log);
  framer.reset();
  framer.feed(bytes_of("3.4,T*2B\r\n" + with_checksum(kHeading)), log);
  EXPECT_EQ(log.sentences, Texts{kHeading});
  EXPECT_TRUE(log.refusals.empty());
}

TEST(SentenceFramer, AProprietaryOneHasItsMakersType) {
  Sentence sentence;
  Refusal refusal;
  ASSERT_TRUE(sentence.assign("$PSRF103,00,01", &refusal));
  EXPECT_TRUE(sentence.is_proprietary());
  EXPECT_EQ(sentence.type(), "SRF103");
  EXPECT_EQ(sentence.field_count(), 2U);
  EXPECT_EQ(sentence.field(1), "01");
}

TEST(SentenceFramer, AnAddressThatIsNoneIsNamed) {
  EXPECT_EQ(framed(with_checksum("$GPGGAX,1")).refusals.size(), 1U);
  EXPECT_TRUE(framed(with_checksum("$gpgga,1")).sentences.empty());
  EXPECT_TRUE(framed(with_checksum("$,")).sentences.empty());
}

/// Sentences between random bytes: all of them are found, whatever the noise begins.
TEST(SentenceFramer, EverySentenceAmongRandomBytesIsFound) {
  const RandomStream random(7, "noise");
  std::string stream;
  Texts expected;
  for (std::uint64_t i = 0; i < 2'000; ++i) {
    const auto length = random.bits(i, 0) % 60;
    for (std::uint64_t k = 0; k < length; ++k) {
      // Bytes that sentences begin and end with are frequent.
      constexpr std::string_view kLikely = "$!\\*,\r\n\x02GP";
      const std::uint64_t bits = random.bits(i, 1 + static_cast<std::uint32_t>(k));
      stream += (bits & 1U) != 0 ? kLikely[(bits >> 8U) % kLikely.size()]
                                 : static_cast<char>(bits >> 16U);
    }
    expected.push_back("$GPTXT,01,01,02," + std::to_string(i));
    stream += with_checksum(expected.back());
  }
  EXPECT_EQ(framed(stream).sentences, expected);
}

}  // namespace
}  // namespace trident::bridges::nmea
