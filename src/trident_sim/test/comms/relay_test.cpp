// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "relay_rig.h"

namespace trident::sim {
namespace {

/// TRIDENT_RELAY_MESSAGES is for long runs.
std::uint64_t message_count() {
  const char* const text = std::getenv("TRIDENT_RELAY_MESSAGES");
  return text == nullptr ? 50000 : std::stoull(text);
}

TEST(Relay, ReliableMessagesComeOnceAndInOrderThroughLossDoublesAndAnOutage) {
  Rig rig({rule(Reliability::kReliable, 100000, 0.0)});
  rig.radio.loss = 0.3;
  rig.radio.doubling = 0.1;
  rig.radio.max_delay = SimTime{40'000'000};
  rig.radio.outage_begin = SimTime::from_seconds(20.0);
  rig.radio.outage_end = SimTime::from_seconds(25.0);
  const std::uint64_t count = message_count();
  std::uint64_t next = 0;
  while (next < count) {
    std::vector<RelayMessage> some;
    for (int i = 0; i < 5 && next < count; ++i) some.push_back(message(next++, rig.radio.now));
    rig.step(some);
  }
  for (int i = 0; i < 20000 && rig.received["b"].size() < count; ++i) rig.step();
  EXPECT_EQ(rig.received["b"], numbers(count));
  EXPECT_EQ(rig.counts().delivered, count);
  EXPECT_GT(rig.counts().resent, count / 4);
  EXPECT_GT(rig.counts().doubles, 0u);
  // A third is lost of parts, and of acknowledgements.
  EXPECT_LT(rig.counts().datagrams, 3 * count);
  for (int i = 0; i < 200; ++i) rig.step();
  const std::uint64_t sent = rig.radio.sent;
  for (int i = 0; i < 200; ++i) rig.step();
  EXPECT_EQ(rig.radio.sent, sent) << "somebody still sends";
}

TEST(Relay, WhatIsTooOldIsGivenUpAndWhatFollowsIsNot) {
  Rig rig({rule(Reliability::kReliable, 1000, 2.0)});
  rig.radio.loss = 0.3;
  rig.radio.outage_begin = SimTime::from_seconds(3.0);
  rig.radio.outage_end = SimTime::from_seconds(8.0);
  std::uint64_t next = 0;
  for (int i = 0; i < 1500; ++i) {
    rig.step(i % 10 == 0 ? std::vector{message(next++, rig.radio.now)}
                         : std::vector<RelayMessage>{});
  }
  for (int i = 0; i < 300; ++i) rig.step();
  const auto& got = rig.received["b"];
  EXPECT_TRUE(std::is_sorted(got.begin(), got.end()));
  EXPECT_EQ(std::adjacent_find(got.begin(), got.end()), got.end());
  EXPECT_LE(*std::max_element(rig.ages.begin(), rig.ages.end()), 2.0);
  // Those of the outage's first three seconds had no time left after it; the others arrive.
  EXPECT_GE(got.size() + rig.counts().expired, next);
  for (std::uint64_t i = 0; i < next; ++i) {
    const double at_s = 0.1 * static_cast<double>(i);
    const bool has_arrived = std::binary_search(got.begin(), got.end(), i);
    const bool had_time = at_s < 1.0 || at_s > 6.7, had_none = at_s > 3.0 && at_s < 6.0;
    EXPECT_TRUE(has_arrived || !had_time) << i;
    EXPECT_FALSE(has_arrived && had_none) << i;
  }
}

TEST(Relay, NewerMessagesForOneRobotReplaceNoneForAnotherOverTheSameHop) {
  Rig rig({rule(Reliability::kBestEffort, 1, 0.0, {"b", "c"}),
           rule(Reliability::kBestEffort, 1, 0.0, {"b"})});
  rig.step({message(0, rig.radio.now)});
  const std::uint32_t flow = rig.radio.histories["b"].flow;
  EXPECT_NE(flow, rig.radio.histories["c"].flow);
  rig.step({message(1, rig.radio.now)});
  EXPECT_EQ(rig.radio.histories["b"].flow, flow) << "of one pair it stays the same";
  rig.relay.offer(1, "a", message(2, rig.radio.now), rig.radio.now, rig.radio);
  EXPECT_NE(rig.radio.histories["b"].flow, flow) << "of another rule";
}

TEST(Relay, BeyondItsDepthAReliableRuleDropsTheOldest) {
  Rig rig({rule(Reliability::kReliable, 5, 0.0)});
  rig.radio.outage_begin = SimTime{0};
  rig.radio.outage_end = SimTime::from_seconds(1.0);
  for (std::uint64_t i = 0; i < 20; ++i) rig.step({message(i, rig.radio.now)});
  for (int i = 0; i < 300; ++i) rig.step();
  EXPECT_EQ(rig.received["b"], (std::vector<std::uint64_t>{15, 16, 17, 18, 19}));
  EXPECT_EQ(rig.counts().superseded, 15u);
}

TEST(Relay, LargeMessagesAreCutAndPutTogether) {
  for (const Reliability reliability : {Reliability::kReliable, Reliability::kBestEffort}) {
    Rig rig({rule(reliability, 100, 0.0)});
    rig.radio.max_delay = SimTime{5'000'000};
    const std::vector<std::size_t> sizes{20, 1400, 1401, 2800, 90000};
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      rig.step({message(i, rig.radio.now, sizes[i])});
    }
    for (int i = 0; i < 100; ++i) rig.step();
    EXPECT_EQ(rig.bytes, sizes);
  }
}

TEST(Relay, BestEffortIsNeverOldNorOutOfOrder) {
  Rig rig({rule(Reliability::kBestEffort, 10, 0.05, {"all"})});
  rig.radio.loss = 0.3;
  rig.radio.doubling = 0.1;
  rig.radio.max_delay = SimTime{80'000'000};
  for (std::uint64_t i = 0; i < 5000; ++i) rig.step({message(i, rig.radio.now)});
  for (int i = 0; i < 20; ++i) rig.step();
  for (const char* robot : {"b", "c"}) {
    const auto& got = rig.received[robot];
    EXPECT_GT(got.size(), 500u);
    EXPECT_TRUE(std::is_sorted(got.begin(), got.end()));
    EXPECT_EQ(std::adjacent_find(got.begin(), got.end()), got.end());
  }
  EXPECT_LE(*std::max_element(rig.ages.begin(), rig.ages.end()), 0.05);
  EXPECT_EQ(rig.radio.sent, 5000u) << "a broadcast is one transmission";
}

TEST(Relay, MaxRateIsTheMeanRate) {
  RelayRule limited = rule(Reliability::kBestEffort, 10, 0.0);
  limited.max_rate_hz = 30.0;
  Rig rig({limited});
  for (std::uint64_t i = 0; i < 1000; ++i) rig.step({message(i, rig.radio.now)});
  EXPECT_NEAR(static_cast<double>(rig.received["b"].size()), 300.0, 1.0);
  EXPECT_EQ(rig.counts().thinned + rig.received["b"].size(), 1000u);
}

TEST(Relay, WhatCannotBeIsReportedOnce) {
  Rig large({rule(Reliability::kBestEffort, 10, 0.0)});
  for (int i = 0; i < 3; ++i) large.step({message(0, large.radio.now, 200000)});
  ASSERT_EQ(large.reports.size(), 1u);
  EXPECT_EQ(large.reports[0],
            "rule 1 (topic): a message of a/topic has 200000 bytes, legal: at most 100000, its "
            "radio's queue; reliable rules take larger ones");
  EXPECT_EQ(large.counts().refused, 3u);

  Rig fast({rule(Reliability::kBestEffort, 10, 0.0, {"all"})});
  for (int i = 0; i < 300; ++i) fast.step({message(0, fast.radio.now, 20000)});
  ASSERT_EQ(fast.reports.size(), 1u);
  EXPECT_NE(fast.reports[0].find("rule 1 (topic): a/topic has 16"), std::string::npos)
      << fast.reports[0];
}

TEST(Relay, OfARobotThatIsReplacedNothingIsKept) {
  Rig rig({rule(Reliability::kReliable, 100, 0.0)});
  rig.step({message(0, rig.radio.now)});
  rig.step();
  rig.relay.set_robots({"a", "c"});
  rig.relay.set_robots({"a", "b", "c"});
  rig.step({message(1, rig.radio.now)});
  rig.step();
  EXPECT_EQ(rig.received["b"], (std::vector<std::uint64_t>{0, 1}));
}

}  // namespace
}  // namespace trident::sim
