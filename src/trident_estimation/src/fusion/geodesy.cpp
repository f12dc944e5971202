// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/fusion/geodesy.h"

#include <cmath>

#include "trident_base/angle.h"

namespace trident::estimation {
namespace {

constexpr double kEquator_m = 6378137.0;
constexpr double kFlattening = 1.0 / 298.257223563;

Eigen::Vector3d earth_centered(const GeodeticPlace& place) {
  const double latitude = deg_to_rad(place.latitude_deg);
  const double longitude = deg_to_rad(place.longitude_deg);
  constexpr double e2 = kFlattening * (2.0 - kFlattening);
  const double sine = std::sin(latitude);
  const double normal = kEquator_m / std::sqrt(1.0 - e2 * sine * sine);
  const double from_axis = (normal + place.height) * std::cos(latitude);
  return {from_axis * std::cos(longitude), from_axis * std::sin(longitude),
          (normal * (1.0 - e2) + place.height) * sine};
}

}  // namespace

Eigen::Vector3d enu_from_geodetic(const GeodeticPlace& place, const GeodeticPlace& origin) {
  const double latitude = deg_to_rad(origin.latitude_deg);
  const double longitude = deg_to_rad(origin.longitude_deg);
  const double sb = std::sin(latitude), cb = std::cos(latitude);
  const double sl = std::sin(longitude), cl = std::cos(longitude);
  const Eigen::Vector3d d = earth_centered(place) - earth_centered(origin);
  return {-sl * d.x() + cl * d.y(), -sb * cl * d.x() - sb * sl * d.y() + cb * d.z(),
          cb * cl * d.x() + cb * sl * d.y() + sb * d.z()};
}

double height_of_pressure(double pressure, double reference) {
  return 44330.77 * (1.0 - std::pow(pressure / reference, 0.1902632));
}

}  // namespace trident::estimation
