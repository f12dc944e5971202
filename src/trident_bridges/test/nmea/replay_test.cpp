// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "trident_bridges/nmea/receive/replay_pacer.h"

namespace trident::bridges::nmea {
namespace {

double due_s(ReplayPacer& pacer, const std::string& text) {
  Sentence sentence;
  Refusal refusal;
  EXPECT_TRUE(sentence.assign(text, &refusal)) << to_text(refusal);
  return pacer.due_s(sentence);
}

TEST(ReplayPacer, SentencesAreDueAtTheTimesInThem) {
  ReplayPacer pacer;
  EXPECT_EQ(due_s(pacer, "$HEHDT,1.0,T"), 0.0);
  EXPECT_EQ(due_s(pacer, "$GPGLL,3305.1,S,07140.5,W,120000.00,A"), 0.0);
  EXPECT_NEAR(due_s(pacer, "$GPGLL,3305.1,S,07140.5,W,120000.20,A"), 0.2, 1e-9);
  EXPECT_NEAR(due_s(pacer, "$HEHDT,1.0,T"), 0.2, 1e-9);
  EXPECT_NEAR(due_s(pacer, "$GPGLL,3305.1,S,07140.5,W,120001.00,A"), 1.0, 1e-9);
}

TEST(ReplayPacer, MidnightIsCrossed) {
  ReplayPacer pacer;
  due_s(pacer, "$GPRMC,235959.00,A,3305.1,S,07140.5,W,1.0,90.0,311226,,,A");
  EXPECT_NEAR(due_s(pacer, "$GPGLL,3305.1,S,07140.5,W,000001.00,A"), 2.0, 1e-9);
}

TEST(ReplayPacer, AGapOrATimeThatWentBackIsCutShort) {
  ReplayPacer pacer;
  due_s(pacer, "$GPGLL,3305.1,S,07140.5,W,120000.00,A");
  EXPECT_NEAR(due_s(pacer, "$GPGLL,3305.1,S,07140.5,W,130000.00,A"), 1.0, 1e-9);
  EXPECT_NEAR(due_s(pacer, "$GPGLL,3305.1,S,07140.5,W,125959.00,A"), 2.0, 1e-9);
}

}  // namespace
}  // namespace trident::bridges::nmea
