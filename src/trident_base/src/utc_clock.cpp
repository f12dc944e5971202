// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/utc_clock.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "trident_base/error.h"

namespace trident {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;
constexpr std::int64_t kSecondsPerDay = 86'400;
constexpr std::int64_t kNsPerWeek = 7 * kSecondsPerDay * kNsPerSecond;
constexpr std::int64_t kGpsEpochDays = 3'657;  ///< 1980-01-06, since 1970-01-01
constexpr std::size_t kTextLength = 20;        ///< of 2026-01-01T00:00:00Z

/// Days before which a leap second was inserted since GPS time began (IERS Bulletin C).
constexpr std::array<CivilDate, 18> kLeapDays{{{1981, 7, 1},
                                               {1982, 7, 1},
                                               {1983, 7, 1},
                                               {1985, 7, 1},
                                               {1988, 1, 1},
                                               {1990, 1, 1},
                                               {1991, 1, 1},
                                               {1992, 7, 1},
                                               {1993, 7, 1},
                                               {1994, 7, 1},
                                               {1996, 1, 1},
                                               {1997, 7, 1},
                                               {1999, 1, 1},
                                               {2006, 1, 1},
                                               {2009, 1, 1},
                                               {2012, 7, 1},
                                               {2015, 7, 1},
                                               {2017, 1, 1}}};

/// GPS seconds at which the leap seconds begin: the last second of the day before.
std::array<std::int64_t, kLeapDays.size()> make_leap_starts() {
  std::array<std::int64_t, kLeapDays.size()> starts{};
  for (std::size_t i = 0; i < starts.size(); ++i) {
    // GPS time counts leap seconds as any others, so that i earlier ones are added.
    const std::int64_t days = days_from_civil(kLeapDays[i]) - kGpsEpochDays;
    starts[i] = days * kSecondsPerDay + static_cast<std::int64_t>(i);
  }
  return starts;
}

const std::array<std::int64_t, kLeapDays.size()>& leap_starts() {
  static const auto starts = make_leap_starts();
  return starts;
}

/// C++ rounds towards zero; days and weeks before an epoch need the floor.
std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

int month_days(int year, int month) {
  constexpr std::array<int, 12> kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool is_leap_year = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return kDays[static_cast<std::size_t>(month - 1)] + (month == 2 && is_leap_year ? 1 : 0);
}

[[noreturn]] void refuse_text(const std::string& text) {
  throw Error("'" + text.substr(0, 40) +
              "' is no instant of UTC, legal: like 2026-01-01T00:00:00Z");
}

/// Two or four digits at `at`; throws by refuse_text() when a character is no digit.
int digits_at(const std::string& text, std::size_t at, std::size_t count) {
  int value = 0;
  for (std::size_t i = at; i < at + count; ++i) {
    if (text[i] < '0' || text[i] > '9') refuse_text(text);
    value = 10 * value + (text[i] - '0');
  }
  return value;
}

std::int32_t fraction_of(const std::string& text) {
  if (text.size() == kTextLength) return 0;
  const std::size_t decimals = text.size() - kTextLength - 1;
  if (text[kTextLength - 1] != '.' || decimals < 1 || decimals > 9) refuse_text(text);
  int value = digits_at(text, kTextLength, decimals);
  for (std::size_t i = decimals; i < 9; ++i) value *= 10;
  return value;
}

/// Since 1970, days of 86,400 s.
std::int64_t calendar_seconds(const UtcTime& utc) {
  return days_from_civil(utc.date) * kSecondsPerDay + utc.hour * 3'600 + utc.minute * 60 +
         utc.second;
}

/// The inverse of calendar_seconds().
UtcTime calendar_of(std::int64_t seconds) {
  const std::int64_t days = floor_div(seconds, kSecondsPerDay);
  const auto of_day = static_cast<int>(seconds - days * kSecondsPerDay);
  return {civil_from_days(days), of_day / 3'600, of_day / 60 % 60, of_day % 60, 0};
}

}  // namespace

bool is_valid(const CivilDate& date) {
  return date.month >= 1 && date.month <= 12 && date.day >= 1 &&
         date.day <= month_days(date.year, date.month);
}

std::int64_t days_from_civil(const CivilDate& date) {
  // Years begin in March, so that a leap day is the last of its year and the lengths of months
  // repeat every five: (153 m + 2) / 5 days before month m. An era of 400 years has 146,097 days;
  // the epoch of 1970 is 719,468 days after 0000-03-01.
  const std::int64_t year = date.year - (date.month <= 2 ? 1 : 0);
  const std::int64_t era = floor_div(year, 400);
  const std::int64_t year_of_era = year - era * 400;
  const std::int64_t day_of_year =
      (153 * (date.month + (date.month > 2 ? -3 : 9)) + 2) / 5 + date.day - 1;
  const std::int64_t day_of_era =
      year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year;
  return era * 146'097 + day_of_era - 719'468;
}

CivilDate civil_from_days(std::int64_t days) {
  // days_from_civil() backwards. The quotients take the leap
  // days of 4, 100 and 400 years out of a day of the era.
  const std::int64_t shifted = days + 719'468;
  const std::int64_t era = floor_div(shifted, 146'097);
  const std::int64_t day_of_era = shifted - era * 146'097;
  const std::int64_t year_of_era =
      (day_of_era - day_of_era / 1'460 + day_of_era / 36'524 - day_of_era / 146'096) / 365;
  const std::int64_t day_of_year =
      day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
  const std::int64_t shifted_month = (5 * day_of_year + 2) / 153;
  const auto month = static_cast<int>(shifted_month + (shifted_month < 10 ? 3 : -9));
  return {static_cast<int>(year_of_era + era * 400) + (month <= 2 ? 1 : 0), month,
          static_cast<int>(day_of_year - (153 * shifted_month + 2) / 5 + 1)};
}

int leap_seconds_at(std::int64_t gps_ns) {
  const auto& starts = leap_starts();
  const std::int64_t second = floor_div(gps_ns, kNsPerSecond);
  return static_cast<int>(std::upper_bound(starts.begin(), starts.end(), second) - starts.begin());
}

std::int64_t gps_ns_of(const UtcTime& utc) {
  // A leap second is inserted before the listed day begins, so that all of that day is after it.
  const auto is_over = [&](const CivilDate& day) {
    return days_from_civil(day) <= days_from_civil(utc.date);
  };
  const auto leaps = std::count_if(kLeapDays.begin(), kLeapDays.end(), is_over);
  const std::int64_t seconds = calendar_seconds(utc) - kGpsEpochDays * kSecondsPerDay + leaps;
  return seconds * kNsPerSecond + utc.nanosecond;
}

UtcTime utc_of(std::int64_t gps_ns) {
  const std::int64_t second = floor_div(gps_ns, kNsPerSecond);
  const auto& starts = leap_starts();
  const bool is_leap = std::binary_search(starts.begin(), starts.end(), second);
  // Within a leap second the calendar is shown of the second before, and then 60.
  const std::int64_t shown = second - leap_seconds_at(gps_ns);
  UtcTime utc = calendar_of(shown + kGpsEpochDays * kSecondsPerDay);
  utc.second += is_leap ? 1 : 0;
  utc.nanosecond = static_cast<std::int32_t>(gps_ns - second * kNsPerSecond);
  return utc;
}

std::int64_t unix_ns_of(const UtcTime& utc) {
  return calendar_seconds(utc) * kNsPerSecond + utc.nanosecond;
}

UtcTime utc_of_unix(std::int64_t unix_ns) {
  const std::int64_t second = floor_div(unix_ns, kNsPerSecond);
  UtcTime utc = calendar_of(second);
  utc.nanosecond = static_cast<std::int32_t>(unix_ns - second * kNsPerSecond);
  return utc;
}

GpsTime gps_time_of(std::int64_t gps_ns) {
  const std::int64_t week = floor_div(gps_ns, kNsPerWeek);
  return {static_cast<int>(week), gps_ns - week * kNsPerWeek};
}

std::string to_text(const UtcTime& utc) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02d-%02dT%02d:%02d:%02d.%09d", utc.date.year,
                utc.date.month, utc.date.day, utc.hour, utc.minute, utc.second, utc.nanosecond);
  std::string result = text.data();
  result.erase(result.find_last_not_of('0') + 1);
  if (result.back() == '.') result.pop_back();
  return result + 'Z';
}

UtcTime utc_from_text(const std::string& text) {
  if (text.size() < kTextLength || text.back() != 'Z') refuse_text(text);
  constexpr std::array<std::pair<std::size_t, char>, 5> kMarks{
      {{4, '-'}, {7, '-'}, {10, 'T'}, {13, ':'}, {16, ':'}}};
  for (const auto& [at, mark] : kMarks) {
    if (text[at] != mark) refuse_text(text);
  }
  UtcTime utc;
  utc.date = {digits_at(text, 0, 4), digits_at(text, 5, 2), digits_at(text, 8, 2)};
  utc.hour = digits_at(text, 11, 2);
  utc.minute = digits_at(text, 14, 2);
  utc.second = digits_at(text, 17, 2);
  utc.nanosecond = fraction_of(text);
  if (!is_valid(utc.date) || utc.hour > 23 || utc.minute > 59 || utc.second > 59) refuse_text(text);
  return utc;
}

UtcClock::UtcClock(const std::string& utc_start) : start_gps_ns_(0) {
  const UtcTime start = utc_from_text(utc_start);
  start_gps_ns_ = gps_ns_of(start);
  if (start_gps_ns_ < 0 || start.date.year > 2079) {
    throw Error("utc_start is " + utc_start + ", legal: from 1980-01-06 to 2079-12-31");
  }
}

}  // namespace trident
