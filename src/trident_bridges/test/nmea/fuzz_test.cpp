// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Random bytes and mutated sentences: nothing crashes, and the next good sentence is read.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "nmea/random_fields.h"
#include "nmea/sentence_log.h"
#include "trident_base/random_stream.h"
#include "trident_bridges/nmea/all_sentences.h"
#include "trident_bridges/nmea/receive/receiver.h"

namespace trident::bridges::nmea {
namespace {

/// Reads what a framer finds; counts headings, which good sentences are.
struct FuzzReading : SentenceSink, ReceiverSink, ProblemSink {
  FuzzReading() : receiver(ReceiverParams{}, *this, *this) {}
  void feed(const std::string& text) {
    receipt.now_s += 0.01;
    framer.feed(bytes_of(text), *this);
  }
  void on_sentence(const Sentence& sentence) override { receiver.read(sentence, receipt); }
  void on_refusal(const Refusal& refusal, std::string_view text) override {
    longest = std::max(longest, to_text(refusal).size() + text.size());
  }
  void on_problem(const Refusal& refusal, const Sentence&) override {
    longest = std::max(longest, to_text(refusal).size());
  }
  void on_heading(double heading_rad) override {
    ++headings;
    last_heading_rad = heading_rad;
  }

  SentenceFramer framer;
  Receiver receiver;
  Receipt receipt;
  std::size_t headings = 0, longest = 0;
  double last_heading_rad = 0.0;
};

const std::string kGood = with_checksum("$HEHDT,57.29577951,T");  // 1 rad

void expect_next_is_read(FuzzReading& reading) {
  const std::size_t before = reading.headings;
  reading.feed("\r\n" + kGood);
  ASSERT_EQ(reading.headings, before + 1);
  ASSERT_NEAR(reading.last_heading_rad, 1.0, 1e-9);
}

/// Random sentences of all types.
template <class... Types>
std::vector<std::string> random_sentences(std::size_t count, SentenceTypes<Types...> /*types*/) {
  RandomFields fields(5);
  std::vector<std::string> sentences;
  const auto add = [&](auto value) {
    value.visit(fields);
    EncodedSentence out;
    Refusal refusal;
    if (encode("GP", value, &out, &refusal)) sentences.emplace_back(out.view());
  };
  while (sentences.size() < count) (add(Types{}), ...);
  return sentences;
}

TEST(Fuzz, AMillionRandomBytesAreSkipped) {
  const RandomStream random(21, "bytes");
  FuzzReading reading;
  constexpr std::uint64_t kBlocks = 10'000;
  for (std::uint64_t block = 0; block < kBlocks; ++block) {
    std::string text;
    for (std::uint32_t i = 0; i < 13; ++i) {
      const std::uint64_t bits = random.bits(block, i);
      for (unsigned shift = 0; shift < 64; shift += 8) text += static_cast<char>(bits >> shift);
    }
    reading.feed(text);
    if (block % 100 == 0) expect_next_is_read(reading);
  }
  EXPECT_EQ(reading.headings, kBlocks / 100);
  EXPECT_GT(reading.framer.counts().bytes, 1'000'000U);
}

std::string mutated(std::string text, const RandomStream& random, std::uint64_t index) {
  const std::uint64_t kind = random.bits(index, 0) % 5;
  const std::size_t at = random.bits(index, 1) % text.size();
  const auto byte = static_cast<char>(random.bits(index, 2));
  switch (kind) {
    case 0:
      text[at] = byte;
      break;
    case 1:
      text.insert(at, 1, byte);
      break;
    case 2:
      text.erase(at, 1 + random.bits(index, 3) % 8);
      break;
    case 3:
      text.insert(at, text.substr(random.bits(index, 3) % text.size()));
      break;
    default:
      // The checksum stays right, so that the change reaches the fields.
      text = text.substr(0, text.find('*'));
      text[1 + at % (text.size() - 1)] = static_cast<char>(' ' + (random.bits(index, 2) % 95));
      return with_checksum(text);
  }
  return text;
}

TEST(Fuzz, MutatedSentencesAreReadOrRefused) {
  const std::vector<std::string> sentences = random_sentences(2'000, AllSentences{});
  const RandomStream random(22, "mutations");
  FuzzReading reading;
  constexpr std::uint64_t kCount = 100'000;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    reading.feed(mutated(sentences[i % sentences.size()], random, i));
    if (i % 1'000 == 0) expect_next_is_read(reading);
  }
  EXPECT_GE(reading.receiver.counts().read, kCount / 20);
  EXPECT_GE(reading.receiver.counts().refused.total(), kCount / 100);
  EXPECT_LE(reading.longest, 400U) << "what is logged stays short";
}

}  // namespace
}  // namespace trident::bridges::nmea
