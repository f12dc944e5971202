// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Sentences of position, speed and date of a satellite receiver (NMEA 0183 4.11).
#pragma once

#include <optional>

#include "trident_base/utc_clock.h"
#include "trident_bridges/nmea/field_values.h"
#include "trident_bridges/nmea/fixed.h"
#include "trident_bridges/nmea/refusal.h"

namespace trident::bridges::nmea {

/// Modes of a fix: autonomous, differential, estimated, RTK float, manual, not valid, precise, RTK
/// fixed, simulator.
inline constexpr const char* kFixModes = "ADEFMNPRS";
/// Status of data: valid or not.
inline constexpr const char* kStatus = "AV";

inline constexpr Limits kAngleLimits{0.0, 360.0};      ///< clockwise from north [deg]
inline constexpr Limits kSpeedLimits{0.0, 100'000.0};  ///< of satellites, too [knots or km/h]
inline constexpr NumberFormat kAngleFormat{2, 1};      ///< 1 cm at 60 m, in degrees
inline constexpr NumberFormat kSpeedFormat{3, 1};      ///< 1 mm/s and less

/// Fills `refusal` with an empty field that is needed, and returns false.
bool refuse_missing(const char* field, const char* legal, Refusal* refusal);

/// A fix: time, position and how good it is.
struct Gga {
  static constexpr const char* kType = "GGA";  ///< as in "$GPGGA"
  /// Of `quality`.
  enum Quality { kNoFix = 0, kSingle = 1, kDifferential = 2, kRtkFixed = 4, kRtkFloat = 5 };

  std::optional<TimeOfDay> time;
  std::optional<double> latitude_deg, longitude_deg;
  std::optional<int> quality;
  std::optional<int> satellites;             ///< in use
  std::optional<double> hdop;                ///< horizontal dilution of precision
  std::optional<double> altitude_m;          ///< above the geoid
  std::optional<double> geoid_separation_m;  ///< of the geoid, above the ellipsoid
  std::optional<double> correction_age_s;    ///< of differential data
  FixedText<4> station;                      ///< that sends them

  /// Lists the fields in their order, for reading, writing and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.time("UTC", time);
    ar.latitude("latitude", latitude_deg);
    ar.longitude("longitude", longitude_deg);
    ar.whole("quality", quality, {0, 8});
    ar.whole("satellites", satellites, {0, 99}, 2);
    ar.real("HDOP", hdop, {0, 9999}, {1, 1});
    ar.real("altitude", altitude_m, {-100'000, 40'000'000}, {3, 1});
    ar.constant("unit of altitude", 'M');
    ar.real("geoid separation", geoid_separation_m, {-1'000, 1'000}, {2, 1});
    ar.constant("unit of geoid separation", 'M');
    ar.real("age of corrections", correction_age_s, {0, 9'999}, {1, 1});
    ar.text("station", station);
  }
  /// A fix needs time and position. False, with `refusal` filled, when one is missing.
  bool check(Refusal* refusal) const;
};

/// Position and time.
struct Gll {
  static constexpr const char* kType = "GLL";  ///< as in "$GPGLL"
  std::optional<double> latitude_deg, longitude_deg;
  std::optional<TimeOfDay> time;
  char status = '\0';  ///< of kStatus
  char mode = '\0';    ///< of kFixModes; '\0': before NMEA 2.3

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.latitude("latitude", latitude_deg);
    ar.longitude("longitude", longitude_deg);
    ar.time("UTC", time);
    ar.letter("status", status, kStatus);
    ar.may_end();
    ar.letter("mode", mode, kFixModes);
  }
  /// A valid one has time and position.
  bool check(Refusal* refusal) const;
};

/// Recommended minimum: time and date, position, speed and course over ground.
struct Rmc {
  static constexpr const char* kType = "RMC";  ///< as in "$GPRMC"
  std::optional<TimeOfDay> time;
  char status = '\0';  ///< of kStatus
  std::optional<double> latitude_deg, longitude_deg;
  std::optional<double> speed_knots;  ///< over ground
  std::optional<double> course_deg;   ///< over ground, from true north
  std::optional<CivilDate> date;
  std::optional<double> variation_deg;  ///< of the magnetic field, east is positive
  char mode = '\0';                     ///< of kFixModes; '\0': before NMEA 2.3
  char navigation = '\0';               ///< safe, caution, unsafe, void; '\0': before NMEA 4.1

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.time("UTC", time);
    ar.letter("status", status, kStatus);
    ar.latitude("latitude", latitude_deg);
    ar.longitude("longitude", longitude_deg);
    ar.real("speed", speed_knots, kSpeedLimits, kSpeedFormat);
    ar.real("course", course_deg, kAngleLimits, kAngleFormat);
    ar.date("date", date);
    ar.sided("magnetic variation", variation_deg, {0, 180}, {1, 1}, "EW");
    ar.may_end();
    ar.letter("mode", mode, kFixModes);
    ar.may_end();
    ar.letter("navigational status", navigation, "SCUV");
  }
  /// A valid one has time, date and position.
  bool check(Refusal* refusal) const;
};

/// Course and speed over ground.
struct Vtg {
  static constexpr const char* kType = "VTG";  ///< as in "$GPVTG"
  std::optional<double> course_deg;            ///< from true north
  std::optional<double> magnetic_course_deg;
  std::optional<double> speed_knots, speed_km_h;
  char mode = '\0';  ///< of kFixModes; '\0': before NMEA 2.3

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("course", course_deg, kAngleLimits, kAngleFormat);
    ar.constant("reference of course", 'T');
    ar.real("magnetic course", magnetic_course_deg, kAngleLimits, kAngleFormat);
    ar.constant("reference of magnetic course", 'M');
    ar.real("speed", speed_knots, kSpeedLimits, kSpeedFormat);
    ar.constant("unit of speed", 'N');
    ar.real("speed in km/h", speed_km_h, {0, 200'000}, kSpeedFormat);
    ar.constant("unit of speed in km/h", 'K');
    ar.may_end();
    ar.letter("mode", mode, kFixModes);
  }
};

/// Date and time.
struct Zda {
  static constexpr const char* kType = "ZDA";  ///< as in "$GPZDA"
  std::optional<TimeOfDay> time;
  std::optional<int> day, month, year;
  std::optional<int> zone_hours, zone_minutes;  ///< added to local time they give UTC

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.time("UTC", time);
    ar.whole("day", day, {1, 31}, 2);
    ar.whole("month", month, {1, 12}, 2);
    ar.whole("year", year, {1980, 2079}, 4);
    ar.whole("zone hours", zone_hours, {-13, 13}, 2);
    ar.whole("zone minutes", zone_minutes, {-59, 59}, 2);
  }
  /// With a time there is a day of the calendar.
  bool check(Refusal* refusal) const;
  /// The day; nothing when a part of it is absent or the calendar has no such day.
  std::optional<CivilDate> date() const;
};

}  // namespace trident::bridges::nmea
