// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_base/config_types.h"
#include "trident_bridges/vehicle/geo_frame.h"

namespace trident::bridges {

/// Where the world's frame begins on the earth.
struct WorldOrigin {
  double latitude = 63.4389;  ///< WGS84 [deg], of the shipped worlds of the sea
  double longitude = 10.399;  ///< WGS84 [deg]
  double altitude = 0.0;      ///< above mean sea level [m]

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("latitude", latitude, Range{-90.0, 90.0}, "WGS84, of the world's origin [deg]");
    ar.field("longitude", longitude, Range{-180.0, 180.0}, "WGS84, of the world's origin [deg]");
    ar.field("altitude", altitude, Range{-1e4, 1e5}, "above mean sea level [m]");
  }
  /// The same as the room `vehicle` takes it.
  mavlink::GeoPlace place() const { return {latitude, longitude, altitude}; }
};

/// Private parameters of mavlink_vehicle_node.
struct MavlinkNodeParams {
  std::string vehicles_file;          ///< see mavlink/vehicles.h
  bool allow_remote = false;          ///< ports may be reached from other computers
  double period_s = 0.02;             ///< between set-points
  bool lockstep = true;               ///< a simulator that offers it waits for set-points
  std::string world_frame = "world";  ///< x to the east, y to the north
  WorldOrigin origin;                 ///< of the world's frame

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("vehicles_file", vehicles_file, "which vehicles, see config/bridges/vehicles.yaml");
    ar.field("allow_remote", allow_remote, "whether ports may be reached from other computers");
    ar.field("period", period_s, Range{0.004, 0.05}, "between set-points, simulated time [s]");
    ar.field("lockstep", lockstep, "whether a simulator that offers it waits for set-points");
    ar.field("world_frame", world_frame, "of the world: x to the east, y to the north, z up");
    ar.field("origin", origin, "where the world's frame begins on the earth");
  }
};

}  // namespace trident::bridges
