// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/sim_time.h"

#include <gtest/gtest.h>

namespace trident {
namespace {

TEST(SimTime, ManyStepsStayExact) {
  const SimTime dt = SimTime::from_seconds(0.01);
  EXPECT_EQ(dt.ns, 10'000'000);
  SimTime t;
  for (int k = 0; k < 360'000; ++k) t = t + dt;
  EXPECT_EQ(t, dt * 360'000);
  EXPECT_EQ(t.seconds(), 3600.0);
}

TEST(SimTime, FromSecondsRoundsToTheNearestNanosecond) {
  EXPECT_EQ(SimTime::from_seconds(0.1 + 0.2).ns, 300'000'000);  // the sum is above 0.3
  EXPECT_EQ(SimTime::from_seconds(1.4e-9).ns, 1);
  EXPECT_EQ(SimTime::from_seconds(1.6e-9).ns, 2);
  EXPECT_EQ(SimTime::from_seconds(-0.25).ns, -250'000'000);
}

TEST(SimTime, OrdersAndSubtracts) {
  const SimTime early{1};
  const SimTime late{3};
  EXPECT_TRUE(early < late && !(late < early) && !(early < early));
  EXPECT_TRUE(early <= late && early <= early && !(late <= early));
  EXPECT_TRUE(late > early && !(early > late) && !(early > early));
  EXPECT_TRUE(late >= early && early >= early && !(early >= late));
  EXPECT_TRUE(early == early && !(early == late));
  EXPECT_TRUE(early != late && !(early != early));
  EXPECT_EQ(late - early, SimTime{2});
  EXPECT_EQ(SimTime{}.ns, 0);
}

TEST(SimTime, SecondsRoundTripForTenDays) {
  for (std::int64_t ns : {1LL, 999'999'999LL, 1'000'000'001LL, 863'999'999'999'999LL}) {
    EXPECT_EQ(SimTime::from_seconds(SimTime{ns}.seconds()).ns, ns);
  }
}

}  // namespace
}  // namespace trident
