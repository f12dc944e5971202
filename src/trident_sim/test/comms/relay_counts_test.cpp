// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "relay_rig.h"

namespace trident::sim {
namespace {

/// Of a flow that is idle.
void expect_each_counted_once(const RelayCounts& counts) {
  EXPECT_EQ(counts.delivered + counts.expired + counts.superseded + counts.refused + counts.thinned,
            counts.offered);
}

TEST(Relay, AMessageThatIsTooOldAtBothEndsIsCountedOnce) {
  Rig rig({rule(Reliability::kReliable, 1000, 0.1)});
  rig.radio.min_delay = SimTime{150'000'000};  // whatever arrives is too old
  rig.radio.max_delay = SimTime{160'000'000};
  for (std::uint64_t i = 0; i < 20; ++i) rig.step({message(i, rig.radio.now)});
  for (int i = 0; i < 300; ++i) rig.step();
  EXPECT_TRUE(rig.received["b"].empty());
  EXPECT_EQ(rig.counts().expired, 20u);
}

TEST(Relay, AMessageWhoseAcknowledgementIsLostIsDeliveredAndNothingElse) {
  for (const int depth : {5, 1000}) {
    Rig rig({rule(Reliability::kReliable, depth, 0.5)});
    rig.radio.is_deaf = {"a"};
    for (std::uint64_t i = 0; i < 20; ++i) rig.step({message(i, rig.radio.now)});
    for (int i = 0; i < 300; ++i) rig.step();
    EXPECT_EQ(rig.received["b"], numbers(20));
    expect_each_counted_once(rig.counts());
  }
}

TEST(Relay, EachMessageIsCountedOnceWhateverIsLost) {
  for (const int depth : {3, 1000}) {
    for (const double deadline_s : {0.1, 0.3, 2.0}) {
      Rig rig({rule(Reliability::kReliable, depth, deadline_s)});
      rig.radio.loss = 0.5;
      rig.radio.doubling = 0.1;
      rig.radio.max_delay = SimTime{80'000'000};
      for (std::uint64_t i = 0; i < 2000; ++i) {
        rig.step({message(i, rig.radio.now, i % 3 == 0 ? 4000 : 20)});
      }
      for (int i = 0; i < 1000; ++i) rig.step();
      EXPECT_EQ(rig.counts().offered, 2000u);
      expect_each_counted_once(rig.counts());
      EXPECT_EQ(rig.counts().delivered, rig.received["b"].size());
    }
  }
}

TEST(Relay, WhatIsThinnedNeedsNoBytes) {
  RelayRule limited = rule(Reliability::kBestEffort, 10, 0.0);
  limited.max_rate_hz = 30.0;
  Rig with({limited}), without({limited});
  for (std::uint64_t i = 0; i < 1000; ++i) {
    with.step({message(i, with.radio.now)});
    RelayMessage bare = message(i, without.radio.now);
    if (without.relay.is_thinned(0, "a", without.radio.now)) bare.data = nullptr;
    without.step({bare});
  }
  EXPECT_EQ(without.received["b"], with.received["b"]);
  EXPECT_EQ(without.counts().thinned, with.counts().thinned);
  EXPECT_FALSE(without.relay.is_thinned(0, "c", without.radio.now)) << "it has had no message";
}

TEST(Relay, WhenTheFirstMessageWasToBeSentIsKnown) {
  Rig rig({rule(Reliability::kReliable, 10, 0.0)});
  rig.step();
  rig.step({message(0, rig.radio.now)});
  rig.step({message(1, rig.radio.now)});
  EXPECT_EQ(rig.counts().first_s, 0.01);
}

}  // namespace
}  // namespace trident::sim
