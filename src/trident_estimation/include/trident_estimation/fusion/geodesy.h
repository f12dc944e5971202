// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace trident::estimation {

/// A place on or above WGS 84's ellipsoid.
struct GeodeticPlace {
  double latitude_deg = 0.0;   ///< [deg]
  double longitude_deg = 0.0;  ///< [deg]
  double height = 0.0;         ///< above the ellipsoid [m]
};

/// A place relative to an origin: east, north, up there [m]. Exact at any distance.
Eigen::Vector3d enu_from_geodetic(const GeodeticPlace& place, const GeodeticPlace& origin);

/// Height above the level where the pressure is `reference` [Pa], by the ICAO standard atmosphere
/// [m]; pressures are above 0.
double height_of_pressure(double pressure, double reference);

}  // namespace trident::estimation
