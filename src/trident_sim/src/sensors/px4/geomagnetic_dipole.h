// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace trident::sim {

/// The Earth's magnetic field as the tilted dipole of IGRF-13's first three coefficients of 2020
/// (Alken et al. 2021: g10 -29404.8, g11 -1450.9, h11 4652.5 nT), in east, north, up [T]. The
/// direction from the Earth's middle is taken from the geodetic latitude, the distance as
/// 6371.2 km and the altitude [m]. It has neither the higher orders nor their change: the
/// declination may be off by more than ten degrees.
Eigen::Vector3d geomagnetic_dipole_enu(double latitude_deg, double longitude_deg,
                                       double altitude_m);

}  // namespace trident::sim
