// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/relay/relay_rules.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "comms/relay/datagram.h"
#include "comms/relay/relay_calls.h"
#include "trident_base/error.h"
#include "trident_base/random_stream.h"
#include "trident_sim/samples/bytes_sample.h"

namespace trident::sim {
namespace {

TEST(Datagram, IsWhatItWas) {
  PartDatagram part;
  part.rule = 513;
  part.number = 1ULL << 40;
  part.oldest = 77;
  part.part = 2;
  part.parts = 3;
  part.born = SimTime{123456789012345};
  part.data = "\x00\xffx";
  const std::string bytes = encode(part);
  const auto back = decode_part(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->rule, 513);
  EXPECT_EQ(back->number, 1ULL << 40);
  EXPECT_EQ(back->oldest, 77u);
  EXPECT_EQ(back->part, 2);
  EXPECT_EQ(back->parts, 3);
  EXPECT_EQ(back->born.ns, 123456789012345);
  EXPECT_EQ(back->data, part.data);
  EXPECT_FALSE(decode_ack(bytes));
  constexpr std::size_t kHeaderBytes = 31;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_EQ(decode_part(bytes.substr(0, size)).has_value(), size >= kHeaderBytes) << size;
  }
  const auto ack = decode_ack(encode(AckDatagram{9, 100, {102, 105}}));
  ASSERT_TRUE(ack);
  EXPECT_EQ(ack->rule, 9);
  EXPECT_EQ(ack->next, 100u);
  EXPECT_EQ(ack->beyond, (std::vector<std::uint64_t>{102, 105}));
}

TEST(Datagram, ChanceBytesAreNone) {
  RandomStream random(3, "bytes");
  std::uint64_t draw = 0;
  for (int i = 0; i < 100000; ++i) {
    std::string bytes(static_cast<std::size_t>(random.uniform(++draw, 0) * 60), '\0');
    for (char& c : bytes) c = static_cast<char>(random.uniform(++draw, 0) * 256);
    if (!bytes.empty() && i % 2 == 0) bytes[0] = i % 4 == 0 ? 'P' : 'A';
    const auto part = decode_part(bytes);
    EXPECT_TRUE(!part || part->parts == 0 || part->part < part->parts);
    decode_ack(bytes);
  }
}

TEST(CallMessages, AreWhatTheyWere) {
  const CallMessage message{CallMessageKind::kError, 1ULL << 50, std::string_view("\0x", 2)};
  const std::string bytes = encode(message);
  const auto back = decode_call(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->kind, CallMessageKind::kError);
  EXPECT_EQ(back->number, 1ULL << 50);
  EXPECT_EQ(back->data, message.data);
  for (std::size_t size = 0; size < 9; ++size) EXPECT_FALSE(decode_call(bytes.substr(0, size)));
  EXPECT_FALSE(decode_call("X12345678"));
}

TEST(StampUse, AMessageCountsAtItsStampUnlessThatIsOfAnotherClock) {
  const SimTime now = SimTime::from_seconds(5.0);
  EXPECT_EQ(stamp_use({}, now), StampUse::kNow);
  EXPECT_EQ(stamp_use(now, now), StampUse::kNow);
  EXPECT_EQ(stamp_use(now + SimTime{1}, now), StampUse::kAtItsStamp);
  EXPECT_EQ(stamp_use(now + kFarAhead, now), StampUse::kAtItsStamp);
  EXPECT_EQ(stamp_use(now + kFarAhead + SimTime{1}, now), StampUse::kOfOtherClock);
}

const char* const kFile = R"(
radio: {tx_power: 10.0, height: 0.3}
model: {path: free_space}
rules:
  - {topic: odometry, from: all, to: all, reliability: best_effort, depth: 1, max_rate: 5.0, deadline: 0.5, priority: 2}
  - {topic: detections, to: [usv1, gcs], reliability: reliable, depth: 50, deadline: 30.0, priority: 0}
)";

TEST(RelayRules, AreRead) {
  const RelayFile file = parse_relay_file(kFile, "team.yaml");
  EXPECT_EQ(file.radio.at("tx_power"), "10.0");
  ASSERT_EQ(file.rules.size(), 2u);
  EXPECT_TRUE(file.rules[0].is_broadcast());
  EXPECT_FALSE(file.rules[1].is_broadcast());
  EXPECT_TRUE(file.rules[1].is_reliable());
  EXPECT_EQ(file.rules[1].to, (std::vector<std::string>{"usv1", "gcs"}));
  EXPECT_TRUE(file.rules[1].is_from("anybody"));
  EXPECT_FALSE(file.rules[1].is_to("anybody"));
}

TEST(RelayRules, AServiceAndATopicOfOneNameAreTwoThings) {
  const RelayFile file = parse_relay_file(
      "rules:\n  - {topic: x}\n  - {service: x, from: a, to: all, deadline: 3}\n", "team.yaml");
  ASSERT_EQ(file.rules.size(), 2u);
  EXPECT_FALSE(file.rules[0].is_service());
  EXPECT_TRUE(file.rules[1].is_service());
  EXPECT_TRUE(file.rules[1].is_reliable());
  EXPECT_FALSE(file.rules[1].is_broadcast());
  EXPECT_EQ(file.rules[1].from, (std::vector<std::string>{"a"}));
}

std::string error_of(const std::string& text) {
  try {
    parse_relay_file(text, "team.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(RelayRules, WhatCannotBeIsOneErrorWithItsLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"rules:\n  - {topic: x, reliability: sure}", "team.yaml:2"},
      {"rules:\n  - {from: all}", "topic"},
      {"rules:\n  - {topic: /x}", "without outer slashes"},
      {"rules:\n  - {topic: from/b/x}", "which a robot has by radio"},
      {"rules:\n  - {topic: x, to: [all, b]}", "names of robots, or all alone"},
      {"rules:\n  - {topic: x, to: []}", "names of robots, or all alone"},
      {"rules:\n  - {topic: x, depth: 0}", "[1, 1e+05]"},
      {"rules:\n  - {topic: x, priority: 4}", "[0, 3]"},
      {"rules:\n  - {topic: x, deadline: .nan}", "team.yaml:2"},
      {"rules:\n  - {topic: x}\n  - {topic: x, from: [a]}", "rule 1 (x) and rule 2 (x)"},
      {"rules:\n  - {service: x}", "deadline: missing required key"},
      {"rules:\n  - {service: x, deadline: 0}", "[0.001, 1e+06]"},
      {"rules:\n  - {service: x, topic: y, deadline: 1}", "topic: unknown key"},
      {"rules:\n  - {service: x, deadline: 1, max_rate: 1}", "max_rate: unknown key"},
      {"rules:\n  - {topic: x, delay: 1}", "delay: unknown key"},
      {"rules:\n  - {service: x, deadline: 1, delay: 1}", "delay is 1, legal: less than deadline"},
      {"rules:\n  - {service: to/b/x, deadline: 1}", "by radio; legal: one of its own"},
      {"rules:\n  - {service: x/, deadline: 1}", "service is 'x/', legal: a name without outer"},
      {"rules:\n  - {service: x, deadline: 1}\n  - {service: x, deadline: 2}",
       "rule 1 (x) and rule 2 (x) relay one service"},
      {"rule: []", "rules"},
  };
  for (const auto& [text, part] : cases) {
    EXPECT_NE(error_of(text).find(part), std::string::npos) << text << "\n" << error_of(text);
  }
}

}  // namespace
}  // namespace trident::sim
