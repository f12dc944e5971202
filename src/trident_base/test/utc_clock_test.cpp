// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/utc_clock.h"

#include <gtest/gtest.h>

#include "trident_base/error.h"

namespace trident {
namespace {

SimTime at_s(double seconds) { return SimTime::from_seconds(seconds); }

std::string start_error(const std::string& text) {
  try {
    UtcClock{text};
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(UtcClock, TimeZeroIsTheStart) {
  EXPECT_EQ(to_text(UtcClock().utc_at({0})), "2026-01-01T00:00:00Z");
  EXPECT_EQ(to_text(UtcClock("2024-02-28T23:59:59.25Z").utc_at(at_s(1.5))),
            "2024-02-29T00:00:00.75Z");
}

TEST(UtcClock, TimeBeforeTheStartIsEarlier) {
  EXPECT_EQ(to_text(UtcClock().utc_at(at_s(-0.5))), "2025-12-31T23:59:59.5Z");
}

// 2026-01-01 is a Thursday: day 4 of the week that began on 2025-12-28, plus 18 leap seconds.
TEST(UtcClock, GpsTimeIsAheadByEighteenSeconds) {
  const GpsTime gps = UtcClock().gps_at({0});
  EXPECT_EQ(gps.week, 2399);
  EXPECT_EQ(gps.time_of_week_ns, (4LL * 86'400 + 18) * 1'000'000'000);
  EXPECT_EQ(leap_seconds_at(UtcClock().gps_ns_at({0})), 18);
}

TEST(UtcClock, GpsTimeBeginsIn1980WithoutLeapSeconds) {
  const UtcClock clock("1980-01-06T00:00:00Z");
  EXPECT_EQ(clock.gps_ns_at({0}), 0);
  EXPECT_EQ(leap_seconds_at(0), 0);
}

TEST(UtcClock, ALeapSecondIsShownAsSecondSixty) {
  const UtcClock clock("2016-12-31T23:59:59Z");
  EXPECT_EQ(to_text(clock.utc_at(at_s(0.5))), "2016-12-31T23:59:59.5Z");
  EXPECT_EQ(to_text(clock.utc_at(at_s(1.25))), "2016-12-31T23:59:60.25Z");
  EXPECT_EQ(to_text(clock.utc_at(at_s(2.0))), "2017-01-01T00:00:00Z");
  EXPECT_EQ(leap_seconds_at(clock.gps_ns_at(at_s(0.0))), 17);
  EXPECT_EQ(leap_seconds_at(clock.gps_ns_at(at_s(2.0))), 18);
}

TEST(UtcClock, UnixTimeCountsNoLeapSeconds) {
  EXPECT_EQ(UtcClock().unix_ns_at(at_s(1.0)), 1'767'225'601LL * 1'000'000'000);
  const UtcClock clock("2016-12-31T23:59:59Z");
  EXPECT_EQ(clock.unix_ns_at(at_s(2.0)) - clock.unix_ns_at({0}), 1'000'000'000);
}

TEST(UtcClock, SimulatedTimeIsFoundAgainFromUtc) {
  const UtcClock clock("2016-12-31T23:59:58.5Z");
  for (int i = 0; i < 40; ++i) {
    const SimTime time = at_s(0.1 * i);
    EXPECT_EQ(clock.sim_time_at(clock.utc_at(time)).ns, time.ns);
  }
}

TEST(UtcClock, UnixTimeIsFoundAgainFromUtc) {
  for (const std::int64_t ns :
       {std::int64_t{0}, std::int64_t{-1}, std::int64_t{1'767'225'600'500'000'000},
        std::int64_t{1'483'228'799'999'999'999}}) {
    EXPECT_EQ(unix_ns_of(utc_of_unix(ns)), ns);
  }
  EXPECT_EQ(to_text(utc_of_unix(1'767'225'600'500'000'000)), "2026-01-01T00:00:00.5Z");
  const GpsTime gps = gps_time_of(gps_ns_of(utc_of_unix(1'767'225'600'000'000'000)));
  EXPECT_EQ(gps.week, 2399);
  EXPECT_EQ(gps.time_of_week_ns, (4LL * 86'400 + 18) * 1'000'000'000);  // a Thursday, 18 s ahead
}

TEST(UtcClock, DaysAreCountedInBothDirections) {
  for (std::int64_t day = -150'000; day < 150'000; day += 17) {
    const CivilDate date = civil_from_days(day);
    EXPECT_TRUE(is_valid(date));
    ASSERT_EQ(days_from_civil(date), day);
  }
  EXPECT_EQ(days_from_civil({1970, 1, 1}), 0);
  EXPECT_EQ(days_from_civil({2000, 3, 1}), 11'017);
}

TEST(UtcClock, DaysThatTheCalendarLacksAreInvalid) {
  EXPECT_FALSE(is_valid({2026, 2, 29}));
  EXPECT_TRUE(is_valid({2024, 2, 29}));
  EXPECT_FALSE(is_valid({1900, 2, 29}));
  EXPECT_FALSE(is_valid({2026, 13, 1}));
  EXPECT_FALSE(is_valid({2026, 4, 31}));
}

TEST(UtcClock, AStartThatIsNoInstantIsNamed) {
  for (const char* const text :
       {"", "2026-01-01", "2026-01-01 00:00:00", "2026-01-01T00:00:00", "2026-02-29T00:00:00Z",
        "2026-01-01T24:00:00Z", "2026-01-01T00:00:60Z", "2026-01-01T00:00:00.Z",
        "2026-01-01T00:00:00.1234567890Z", "2026-0x-01T00:00:00Z"}) {
    EXPECT_EQ(start_error(text),
              "'" + std::string(text) + "' is no instant of UTC, legal: like 2026-01-01T00:00:00Z");
  }
  EXPECT_EQ(start_error("1979-12-31T00:00:00Z"),
            "utc_start is 1979-12-31T00:00:00Z, legal: from 1980-01-06 to 2079-12-31");
  EXPECT_EQ(start_error("2080-01-01T00:00:00Z").substr(0, 9), "utc_start");
}

}  // namespace
}  // namespace trident
