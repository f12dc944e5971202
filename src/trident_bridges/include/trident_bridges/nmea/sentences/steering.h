// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Sentences from a route planner to an autopilot.
#pragma once

#include <optional>

#include "trident_bridges/nmea/fixed.h"
#include "trident_bridges/nmea/sentences/position.h"

namespace trident::bridges::nmea {

using WaypointName = FixedText<24>;  ///< of a place

inline constexpr const char* kReferences = "TM";  ///< true or magnetic north
inline constexpr Limits kRangeLimits{0.0, 1e5};   ///< [nautical miles]

/// How far the vessel is off the track, and where it is to steer to be on it again.
struct CrossTrack {
  std::optional<double> distance_nm;  ///< right of the track is positive: it has to steer left

  /// Lists the fields in their order: the magnitude and the side to steer to.
  template <class Archive>
  void visit(Archive& ar) {
    ar.sided("cross-track error", distance_nm, {0, 9'999}, {4, 1}, "LR");
  }
};

/// Autopilot sentence B: track, destination, heading to steer.
struct Apb {
  static constexpr const char* kType = "APB";  ///< as in "$GPAPB"
  char status = '\0', warning = '\0';          ///< of kStatus: V is not usable
  CrossTrack cross_track;
  char arrived = '\0', passed = '\0';  ///< A: in the circle, past the perpendicular
  std::optional<double> bearing_from_origin_deg;
  char bearing_from_origin_reference = '\0';  ///< of kReferences
  WaypointName destination;
  std::optional<double> bearing_deg;  ///< from the vessel to the destination
  char bearing_reference = '\0';      ///< of kReferences
  std::optional<double> heading_deg;  ///< to steer
  char heading_reference = '\0';      ///< of kReferences
  char mode = '\0';                   ///< of kFixModes; '\0': before NMEA 2.3

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.letter("status", status, kStatus);
    ar.letter("warning", warning, kStatus);
    cross_track.visit(ar);
    ar.constant("unit of cross-track error", 'N');
    ar.letter("arrival", arrived, kStatus);
    ar.letter("perpendicular", passed, kStatus);
    ar.real("bearing from origin", bearing_from_origin_deg, kAngleLimits, kAngleFormat);
    ar.letter("reference of bearing from origin", bearing_from_origin_reference, kReferences);
    ar.text("destination", destination);
    ar.real("bearing", bearing_deg, kAngleLimits, kAngleFormat);
    ar.letter("reference of bearing", bearing_reference, kReferences);
    ar.real("heading to steer", heading_deg, kAngleLimits, kAngleFormat);
    ar.letter("reference of heading to steer", heading_reference, kReferences);
    ar.may_end();
    ar.letter("mode", mode, kFixModes);
  }
};

/// Autopilot sentence A: track alone.
struct Apa {
  static constexpr const char* kType = "APA";  ///< as in "$GPAPA"
  char status = '\0', warning = '\0';          ///< of kStatus: V is not usable
  CrossTrack cross_track;
  char arrived = '\0', passed = '\0';  ///< A: in the circle, past the perpendicular
  std::optional<double> bearing_from_origin_deg;
  char bearing_reference = '\0';  ///< of kReferences
  WaypointName destination;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.letter("status", status, kStatus);
    ar.letter("warning", warning, kStatus);
    cross_track.visit(ar);
    ar.constant("unit of cross-track error", 'N');
    ar.letter("arrival", arrived, kStatus);
    ar.letter("perpendicular", passed, kStatus);
    ar.real("bearing from origin", bearing_from_origin_deg, kAngleLimits, kAngleFormat);
    ar.letter("reference of bearing from origin", bearing_reference, kReferences);
    ar.text("destination", destination);
  }
};

/// Recommended minimum of navigation: destination, and where it lies.
struct Rmb {
  static constexpr const char* kType = "RMB";  ///< as in "$GPRMB"
  char status = '\0';                          ///< of kStatus
  CrossTrack cross_track;
  WaypointName origin, destination;
  std::optional<double> latitude_deg, longitude_deg;  ///< of the destination
  std::optional<double> range_nm, bearing_deg;        ///< to it, from true north
  std::optional<double> closing_knots;
  char arrived = '\0';  ///< A: in the circle or past the perpendicular
  char mode = '\0';     ///< of kFixModes; '\0': before NMEA 2.3

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.letter("status", status, kStatus);
    cross_track.visit(ar);
    ar.text("origin", origin);
    ar.text("destination", destination);
    ar.latitude("latitude of the destination", latitude_deg);
    ar.longitude("longitude of the destination", longitude_deg);
    ar.real("range", range_nm, kRangeLimits, {3, 1});
    ar.real("bearing", bearing_deg, kAngleLimits, kAngleFormat);
    ar.real("closing speed", closing_knots, {-1'000, 1'000}, {2, 1});
    ar.letter("arrival", arrived, kStatus);
    ar.may_end();
    ar.letter("mode", mode, kFixModes);
  }
};

/// Cross-track error alone.
struct Xte {
  static constexpr const char* kType = "XTE";  ///< as in "$GPXTE"
  char status = '\0', warning = '\0';          ///< of kStatus: V is not usable
  CrossTrack cross_track;
  char mode = '\0';  ///< of kFixModes; '\0': before NMEA 2.3

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.letter("status", status, kStatus);
    ar.letter("warning", warning, kStatus);
    cross_track.visit(ar);
    ar.constant("unit of cross-track error", 'N');
    ar.may_end();
    ar.letter("mode", mode, kFixModes);
  }
};

}  // namespace trident::bridges::nmea
