// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Sentences of satellites and of the errors of a fix.
#pragma once

#include <array>
#include <optional>

#include "trident_bridges/nmea/field_values.h"
#include "trident_bridges/nmea/fixed.h"
#include "trident_bridges/nmea/sentences/position.h"

namespace trident::bridges::nmea {

inline constexpr Limits kErrorLimits{0.0, 1e7};                ///< [m]
inline constexpr NumberFormat kErrorFormat{3, 1};              ///< [m]
inline constexpr const char* kSystemIds = "0123456789ABCDEF";  ///< of NMEA 4.11, and of signals

/// Satellites in use, and dilution of precision.
struct Gsa {
  static constexpr const char* kType = "GSA";  ///< as in "$GPGSA"
  char selection = '\0';          ///< of two or three dimensions: manual M or automatic A
  std::optional<int> dimensions;  ///< 1: no fix, 2, 3
  std::array<std::optional<int>, 12> satellites;
  std::optional<double> pdop, hdop, vdop;  ///< of position, level, height
  char system = '\0';                      ///< of satellites; '\0': before NMEA 4.1

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.letter("selection", selection, "MA");
    ar.whole("dimensions", dimensions, {1, 3});
    for (std::optional<int>& satellite : satellites) ar.whole("satellite", satellite, {1, 999}, 2);
    ar.real("PDOP", pdop, {0, 9999}, {1, 1});
    ar.real("HDOP", hdop, {0, 9999}, {1, 1});
    ar.real("VDOP", vdop, {0, 9999}, {1, 1});
    ar.may_end();
    ar.letter("system", system, kSystemIds);
  }
};

/// One satellite in view.
struct SatelliteInView {
  static constexpr std::size_t kFields = 4;  ///< of a group
  std::optional<int> number;
  std::optional<int> elevation_deg, azimuth_deg;
  std::optional<int> snr_db;  ///< carrier over noise; absent: not tracked

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.whole("satellite", number, {1, 999}, 2);
    ar.whole("elevation", elevation_deg, {-90, 90}, 2);
    ar.whole("azimuth", azimuth_deg, {0, 360}, 3);
    ar.whole("SNR", snr_db, {0, 99}, 2);
  }
};

/// Satellites in view, four in a sentence.
struct Gsv {
  static constexpr const char* kType = "GSV";  ///< as in "$GPGSV"
  std::optional<int> total, number;            ///< of sentences; of this one, from 1 on
  std::optional<int> in_view;                  ///< satellites
  FixedList<SatelliteInView, 4> satellites;
  char signal = '\0';  ///< '\0': before NMEA 4.1

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.whole("number of sentences", total, {1, 99});
    ar.whole("sentence", number, {1, 99});
    ar.whole("satellites in view", in_view, {0, 999}, 2);
    ar.groups("satellites", satellites, 1);
    ar.may_end();
    ar.letter("signal", signal, kSystemIds);
  }
};

/// Errors of a fix, one standard deviation.
struct Gst {
  static constexpr const char* kType = "GST";  ///< as in "$GPGST"
  std::optional<TimeOfDay> time;
  std::optional<double> range_rms_m;  ///< of the ranges that went into the fix
  std::optional<double> major_m, minor_m, orientation_deg;  ///< of the ellipse, from true north
  std::optional<double> latitude_m, longitude_m, altitude_m;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.time("UTC", time);
    ar.real("range RMS", range_rms_m, kErrorLimits, kErrorFormat);
    ar.real("semi-major axis", major_m, kErrorLimits, kErrorFormat);
    ar.real("semi-minor axis", minor_m, kErrorLimits, kErrorFormat);
    ar.real("orientation", orientation_deg, kAngleLimits, {1, 1});
    ar.real("error of latitude", latitude_m, kErrorLimits, kErrorFormat);
    ar.real("error of longitude", longitude_m, kErrorLimits, kErrorFormat);
    ar.real("error of altitude", altitude_m, kErrorLimits, kErrorFormat);
  }
};

/// Satellite fault detection: expected errors, and the satellite that is most likely wrong.
struct Gbs {
  static constexpr const char* kType = "GBS";  ///< as in "$GPGBS"
  std::optional<TimeOfDay> time;
  std::optional<double> latitude_m, longitude_m, altitude_m;
  std::optional<int> satellite;
  std::optional<double> probability;            ///< that the failed satellite was not detected
  std::optional<double> bias_m, bias_stddev_m;  ///< of that satellite
  char system = '\0', signal = '\0';            ///< '\0': before NMEA 4.1

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.time("UTC", time);
    ar.real("error of latitude", latitude_m, kErrorLimits, kErrorFormat);
    ar.real("error of longitude", longitude_m, kErrorLimits, kErrorFormat);
    ar.real("error of altitude", altitude_m, kErrorLimits, kErrorFormat);
    ar.whole("satellite", satellite, {1, 999}, 2);
    ar.real("probability", probability, {0, 1}, {3, 1});
    ar.real("bias", bias_m, {-1e7, 1e7}, kErrorFormat);
    ar.real("error of bias", bias_stddev_m, kErrorLimits, kErrorFormat);
    ar.may_end();
    ar.letter("system", system, kSystemIds);
    ar.letter("signal", signal, kSystemIds);
  }
};

/// Datum of positions.
struct Dtm {
  static constexpr const char* kType = "DTM";                       ///< as in "$GPDTM"
  FixedText<3> datum;                                               ///< "W84": WGS 84
  FixedText<8> subdivision;                                         ///< of a local datum
  std::optional<double> latitude_offset_min, longitude_offset_min;  ///< north, east [minutes]
  std::optional<double> altitude_offset_m;
  FixedText<3> reference;  ///< datum that the offsets are from

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.text("datum", datum);
    ar.text("subdivision", subdivision);
    ar.sided("offset of latitude", latitude_offset_min, {0, 60}, {4, 1}, "NS");
    ar.sided("offset of longitude", longitude_offset_min, {0, 60}, {4, 1}, "EW");
    ar.real("offset of altitude", altitude_offset_m, {-1e4, 1e4}, {1, 1});
    ar.text("reference datum", reference);
  }
};

}  // namespace trident::bridges::nmea
