// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Sentences of speed logs and echo sounders.
#pragma once

#include <optional>

#include "trident_bridges/nmea/sentences/position.h"

namespace trident::bridges::nmea {

inline constexpr Limits kSignedSpeedLimits{-1'000.0, 1'000.0};  ///< of vessels [knots]
inline constexpr Limits kDistanceLimits{0.0, 1e7};              ///< [nautical miles]
inline constexpr Limits kDepthLimits{0.0, 1e5};                 ///< in any of the units
inline constexpr NumberFormat kDepthFormat{2, 1};

/// Heading, and speed through the water.
struct Vhw {
  static constexpr const char* kType = "VHW";  ///< as in "$VWVHW"
  std::optional<double> heading_deg, magnetic_heading_deg;
  std::optional<double> speed_knots, speed_km_h;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("heading", heading_deg, kAngleLimits, kAngleFormat);
    ar.constant("reference of heading", 'T');
    ar.real("magnetic heading", magnetic_heading_deg, kAngleLimits, kAngleFormat);
    ar.constant("reference of magnetic heading", 'M');
    ar.real("speed", speed_knots, kSignedSpeedLimits, kSpeedFormat);
    ar.constant("unit of speed", 'N');
    ar.real("speed in km/h", speed_km_h, {-2'000, 2'000}, kSpeedFormat);
    ar.constant("unit of speed in km/h", 'K');
  }
};

/// Speeds along and across the vessel, through the water and over ground.
struct Vbw {
  static constexpr const char* kType = "VBW";  ///< as in "$VDVBW"
  std::optional<double> water_ahead_knots, water_starboard_knots;
  char water_status = '\0';  ///< of kStatus
  std::optional<double> ground_ahead_knots, ground_starboard_knots;
  char ground_status = '\0';                                    ///< of kStatus
  std::optional<double> water_stern_knots, ground_stern_knots;  ///< to starboard, at the stern
  char water_stern_status = '\0', ground_stern_status = '\0';   ///< of kStatus

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("water speed ahead", water_ahead_knots, kSignedSpeedLimits, kSpeedFormat);
    ar.real("water speed to starboard", water_starboard_knots, kSignedSpeedLimits, kSpeedFormat);
    ar.letter("status of water speed", water_status, kStatus);
    ar.real("ground speed ahead", ground_ahead_knots, kSignedSpeedLimits, kSpeedFormat);
    ar.real("ground speed to starboard", ground_starboard_knots, kSignedSpeedLimits, kSpeedFormat);
    ar.letter("status of ground speed", ground_status, kStatus);
    ar.may_end();
    ar.real("water speed of the stern", water_stern_knots, kSignedSpeedLimits, kSpeedFormat);
    ar.letter("status of water speed of the stern", water_stern_status, kStatus);
    ar.real("ground speed of the stern", ground_stern_knots, kSignedSpeedLimits, kSpeedFormat);
    ar.letter("status of ground speed of the stern", ground_stern_status, kStatus);
  }
};

/// Distances made good.
struct Vlw {
  static constexpr const char* kType = "VLW";  ///< as in "$VWVLW"
  std::optional<double> water_total_nm, water_trip_nm, ground_total_nm, ground_trip_nm;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("distance through water", water_total_nm, kDistanceLimits, {3, 1});
    ar.constant("unit of distance through water", 'N');
    ar.real("trip through water", water_trip_nm, kDistanceLimits, {3, 1});
    ar.constant("unit of trip through water", 'N');
    ar.may_end();
    ar.real("distance over ground", ground_total_nm, kDistanceLimits, {3, 1});
    ar.constant("unit of distance over ground", 'N');
    ar.real("trip over ground", ground_trip_nm, kDistanceLimits, {3, 1});
    ar.constant("unit of trip over ground", 'N');
  }
};

/// Depth below the transducer.
struct Dbt {
  static constexpr const char* kType = "DBT";  ///< as in "$SDDBT"
  std::optional<double> depth_feet, depth_m, depth_fathoms;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("depth in feet", depth_feet, kDepthLimits, kDepthFormat);
    ar.constant("unit of depth in feet", 'f');
    ar.real("depth", depth_m, kDepthLimits, kDepthFormat);
    ar.constant("unit of depth", 'M');
    ar.real("depth in fathoms", depth_fathoms, kDepthLimits, kDepthFormat);
    ar.constant("unit of depth in fathoms", 'F');
  }
};

/// Depth below the transducer, and where that is.
struct Dpt {
  static constexpr const char* kType = "DPT";  ///< as in "$SDDPT"
  std::optional<double> depth_m;
  std::optional<double> offset_m;  ///< up to the waterline is positive, down to the keel negative
  std::optional<double> max_range_m;  ///< of the scale in use; absent: before NMEA 3

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("depth", depth_m, kDepthLimits, kDepthFormat);
    ar.real("offset", offset_m, {-1'000, 1'000}, kDepthFormat);
    ar.may_end();
    ar.real("range", max_range_m, kDepthLimits, {1, 1});
  }
};

/// Temperature of the water.
struct Mtw {
  static constexpr const char* kType = "MTW";  ///< as in "$YXMTW"
  std::optional<double> temperature_c;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("temperature", temperature_c, {-100, 200}, {2, 1});
    ar.constant("unit of temperature", 'C');
  }
};

}  // namespace trident::bridges::nmea
