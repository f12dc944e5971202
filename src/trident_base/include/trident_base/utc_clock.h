// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Simulated time as UTC and as GPS time: the one place where the two are converted.
#pragma once

#include <cstdint>
#include <string>

#include "trident_base/sim_time.h"

namespace trident {

/// A day of the Gregorian calendar.
struct CivilDate {
  int year = 1980;  ///< with its century
  int month = 1;    ///< [1, 12]
  int day = 6;      ///< [1, 31], as the month has them

  friend bool operator==(const CivilDate& a, const CivilDate& b) {
    return a.year == b.year && a.month == b.month && a.day == b.day;
  }
};

/// Whether the calendar has such a day.
bool is_valid(const CivilDate& date);
/// Days since 1970-01-01, negative before it. Requires a valid date. Source: Hinnant,
/// "chrono-compatible low-level date algorithms", days_from_civil.
std::int64_t days_from_civil(const CivilDate& date);
/// The inverse of days_from_civil().
CivilDate civil_from_days(std::int64_t days);

/// An instant of UTC.
struct UtcTime {
  CivilDate date;
  int hour = 0;                 ///< [0, 23]
  int minute = 0;               ///< [0, 59]
  int second = 0;               ///< [0, 60]; 60 in a leap second only
  std::int32_t nanosecond = 0;  ///< [0, 1e9)
};

/// Time of the Global Positioning System: it began at 1980-01-06T00:00:00Z and has no leap seconds.
struct GpsTime {
  int week = 0;                      ///< since the beginning, not modulo 1024
  std::int64_t time_of_week_ns = 0;  ///< [0, 604800e9)
};

/// GPS time minus UTC at an instant given in nanoseconds of GPS time since its beginning [s]: 18
/// since 2017-01-01. Source: IERS Bulletin C; no later leap second is announced.
int leap_seconds_at(std::int64_t gps_ns);

/// Nanoseconds of GPS time since its beginning at an instant of UTC. Requires a valid date; a
/// second of 60 where there is no leap second is the first of the next minute.
std::int64_t gps_ns_of(const UtcTime& utc);
/// The inverse of gps_ns_of(), with second 60 in leap seconds.
UtcTime utc_of(std::int64_t gps_ns);
/// Nanoseconds of Unix time, which counts no leap seconds: second 60 is the next second 0.
std::int64_t unix_ns_of(const UtcTime& utc);
/// The inverse of unix_ns_of(), without leap seconds.
UtcTime utc_of_unix(std::int64_t unix_ns);
/// Week and time of week of an instant not before 1980.
GpsTime gps_time_of(std::int64_t gps_ns);
/// "2026-01-01T00:00:00Z", with as many decimals of a second as it needs.
std::string to_text(const UtcTime& utc);
/// The instant written as 2026-01-01T00:00:00Z, seconds with up to 9 decimals. Throws Error naming
/// the text and what is legal.
UtcTime utc_from_text(const std::string& text);

/// Which UTC simulated time 0 is.
class UtcClock {
 public:
  /// The start of all worlds that name no other.
  static constexpr const char* kDefaultStart = "2026-01-01T00:00:00Z";

  /// `utc_start`: as utc_from_text() reads it, from 1980-01-06 to 2079-12-31, because NMEA 0183
  /// and MAVLink carry two digits of the year, or weeks of GPS. Throws Error naming it and what is
  /// legal.
  explicit UtcClock(const std::string& utc_start = kDefaultStart);

  /// Leap seconds pass as they do on earth: a second 60 is given where there is one.
  UtcTime utc_at(SimTime time) const { return utc_of(gps_ns_at(time)); }
  /// `time` not before 1980.
  GpsTime gps_at(SimTime time) const { return gps_time_of(gps_ns_at(time)); }
  std::int64_t gps_ns_at(SimTime time) const { return start_gps_ns_ + time.ns; }  ///< since 1980
  std::int64_t unix_ns_at(SimTime time) const { return unix_ns_of(utc_at(time)); }
  /// Simulated time at an instant of UTC; negative before utc_start.
  SimTime sim_time_at(const UtcTime& utc) const { return {gps_ns_of(utc) - start_gps_ns_}; }

 private:
  std::int64_t start_gps_ns_;
};

}  // namespace trident
