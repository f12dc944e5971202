// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Sentences of wind sensors.
#pragma once

#include <optional>

#include "trident_bridges/nmea/sentences/position.h"

namespace trident::bridges::nmea {

inline constexpr Limits kWindLimits{0.0, 1'000.0};  ///< in any of the units

/// Wind by the bow: apparent (R) or true (T).
struct Mwv {
  static constexpr const char* kType = "MWV";  ///< as in "$WIMWV"
  std::optional<double> angle_deg;             ///< where it comes from, from the bow clockwise
  char reference = '\0';                       ///< R or T
  std::optional<double> speed;                 ///< in `unit`
  char unit = '\0';                            ///< km/h, m/s, knots, statute miles/h
  char status = '\0';                          ///< of kStatus

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("angle", angle_deg, kAngleLimits, kAngleFormat);
    ar.letter("reference", reference, "RT");
    ar.real("speed", speed, kWindLimits, {2, 1});
    ar.letter("unit", unit, "KMNS");
    ar.letter("status", status, kStatus);
  }
};

/// True wind by the compass.
struct Mwd {
  static constexpr const char* kType = "MWD";                   ///< as in "$WIMWD"
  std::optional<double> direction_deg, magnetic_direction_deg;  ///< where it comes from
  std::optional<double> speed_knots, speed_m_s;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("direction", direction_deg, kAngleLimits, kAngleFormat);
    ar.constant("reference of direction", 'T');
    ar.real("magnetic direction", magnetic_direction_deg, kAngleLimits, kAngleFormat);
    ar.constant("reference of magnetic direction", 'M');
    ar.real("speed", speed_knots, kWindLimits, {2, 1});
    ar.constant("unit of speed", 'N');
    ar.real("speed in m/s", speed_m_s, kWindLimits, {2, 1});
    ar.constant("unit of speed in m/s", 'M');
  }
};

/// Wind by the bow, on one of its sides.
struct SidedWind {
  std::optional<double> angle_deg;  ///< from the bow, to starboard is positive
  std::optional<double> speed_knots, speed_m_s, speed_km_h;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.sided("angle", angle_deg, {0, 180}, kAngleFormat, "RL");
    ar.real("speed", speed_knots, kWindLimits, {2, 1});
    ar.constant("unit of speed", 'N');
    ar.real("speed in m/s", speed_m_s, kWindLimits, {2, 1});
    ar.constant("unit of speed in m/s", 'M');
    ar.real("speed in km/h", speed_km_h, {0, 3'600}, {2, 1});
    ar.constant("unit of speed in km/h", 'K');
  }
};

/// Apparent wind.
struct Vwr : SidedWind {
  static constexpr const char* kType = "VWR";  ///< as in "$WIVWR"
};

/// True wind.
struct Vwt : SidedWind {
  static constexpr const char* kType = "VWT";  ///< as in "$WIVWT"
};

}  // namespace trident::bridges::nmea
