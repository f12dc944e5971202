// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Sentences of waypoints and routes.
#pragma once

#include <optional>

#include "trident_bridges/nmea/fixed.h"
#include "trident_bridges/nmea/sentences/position.h"
#include "trident_bridges/nmea/sentences/steering.h"

namespace trident::bridges::nmea {

/// Bearing from the origin of a leg to its destination.
struct Bod {
  static constexpr const char* kType = "BOD";  ///< as in "$GPBOD"
  std::optional<double> bearing_deg, magnetic_bearing_deg;
  WaypointName destination, origin;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.real("bearing", bearing_deg, kAngleLimits, kAngleFormat);
    ar.constant("reference of bearing", 'T');
    ar.real("magnetic bearing", magnetic_bearing_deg, kAngleLimits, kAngleFormat);
    ar.constant("reference of magnetic bearing", 'M');
    ar.text("destination", destination);
    ar.text("origin", origin);
  }
};

/// Bearing and distance to a waypoint along a great circle.
struct Bwc {
  static constexpr const char* kType = "BWC";  ///< as in "$GPBWC"
  std::optional<TimeOfDay> time;
  std::optional<double> latitude_deg, longitude_deg;  ///< of the waypoint
  std::optional<double> bearing_deg, magnetic_bearing_deg;
  std::optional<double> distance_nm;
  WaypointName waypoint;
  char mode = '\0';  ///< of kFixModes; '\0': before NMEA 2.3

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.time("UTC", time);
    ar.latitude("latitude of the waypoint", latitude_deg);
    ar.longitude("longitude of the waypoint", longitude_deg);
    ar.real("bearing", bearing_deg, kAngleLimits, {1, 1});
    ar.constant("reference of bearing", 'T');
    ar.real("magnetic bearing", magnetic_bearing_deg, kAngleLimits, {1, 1});
    ar.constant("reference of magnetic bearing", 'M');
    ar.real("distance", distance_nm, kRangeLimits, {3, 1});
    ar.constant("unit of distance", 'N');
    ar.text("waypoint", waypoint);
    ar.may_end();
    ar.letter("mode", mode, kFixModes);
  }
};

/// Place of a waypoint.
struct Wpl {
  static constexpr const char* kType = "WPL";  ///< as in "$GPWPL"
  std::optional<double> latitude_deg, longitude_deg;
  WaypointName name;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.latitude("latitude", latitude_deg);
    ar.longitude("longitude", longitude_deg);
    ar.text("name", name);
  }
  /// It has a name and a place.
  bool check(Refusal* refusal) const;
};

/// A waypoint's name in a route.
struct RouteEntry {
  static constexpr std::size_t kFields = 1;  ///< of a group
  WaypointName name;

  /// Lists the field.
  template <class Archive>
  void visit(Archive& ar) {
    ar.text("waypoint", name);
  }
};

/// A route, or a part of it.
struct Rte {
  static constexpr const char* kType = "RTE";  ///< as in "$GPRTE"
  std::optional<int> total, number;            ///< of sentences; of this one, from 1 on
  char mode = '\0';                            ///< complete c, or working w: what is left of it
  FixedText<24> route;                         ///< its name
  FixedList<RouteEntry, 30> waypoints;

  /// Lists the fields in their order.
  template <class Archive>
  void visit(Archive& ar) {
    ar.whole("number of sentences", total, {1, 999});
    ar.whole("sentence", number, {1, 999});
    ar.letter("mode", mode, "cw");
    ar.text("route", route);
    ar.groups("waypoints", waypoints);
  }
  /// It has a number within its total.
  bool check(Refusal* refusal) const;
};

}  // namespace trident::bridges::nmea
