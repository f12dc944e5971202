// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "allocation_count.h"
#include "nmea/sentence_log.h"
#include "trident_bridges/nmea/receive/receiver.h"
#include "trident_bridges/nmea/send/gnss_talker.h"
#include "trident_bridges/nmea/send/instrument_talker.h"

namespace trident::bridges::nmea {
namespace {

/// Reads what is sent.
struct Loop : TalkerSink, SentenceSink, ReceiverSink, ProblemSink {
  void on_sentence(std::string_view sentence, SimTime) override {
    framer.feed(bytes_of(sentence), *this);
  }
  void on_problem(std::string_view, const Refusal&) override { ++problems; }
  void on_sentence(const Sentence& sentence) override { receiver.read(sentence, {}); }
  void on_refusal(const Refusal&, std::string_view) override { ++problems; }
  void on_problem(const Refusal&, const Sentence&) override { ++problems; }
  void on_fix(const NavsatFix&) override { ++fixes; }

  SentenceFramer framer;
  Receiver receiver{ReceiverParams{}, *this, *this};
  int fixes = 0, problems = 0;
};

TEST(Allocation, SentencesAreSentAndReadWithoutAny) {
  Loop loop;
  SentenceSender sender(TalkerParams{}, loop);
  GnssTalker gnss(sender, UtcClock());
  InstrumentTalker instruments(sender);
  GnssEpoch epoch;
  epoch.fix = GnssEpoch::Fix::kFixed;
  epoch.satellites = 12;
  const auto run = [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      epoch.stamp = SimTime::from_seconds(0.2 * i);
      gnss.set_velocity({1.0, 2.0});
      gnss.on_epoch(epoch);
      instruments.on_attitude(epoch.stamp, {1.0, 0.0, 0.0, 0.1});
      instruments.on_wind(epoch.stamp, {false, 5.0, 1.0});
    }
  };
  run(0, 10);
  EXPECT_EQ(allocations_of([&] { run(10, 1'000); }), 0U);
  EXPECT_EQ(loop.fixes, 1'000);
  EXPECT_EQ(loop.problems, 0);
}

TEST(Allocation, RefusalsAllocateNothing) {
  Loop loop;
  const std::string bad = "$HEHDT,1.0,T*00\r\n\xb5\x62" + with_checksum("$HEHDT,400.0,T") +
                          with_checksum("$GPGGA,1") + with_checksum("!AIVDM,2,2,1,A,0000,0");
  EXPECT_EQ(allocations_of([&] {
              for (int i = 0; i < 100; ++i) loop.framer.feed(bytes_of(bad), loop);
            }),
            0U);
  EXPECT_EQ(loop.problems, 400);
}

}  // namespace
}  // namespace trident::bridges::nmea
