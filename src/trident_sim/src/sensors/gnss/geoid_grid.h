// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace trident::sim {

/// Where PROJ keeps the EGM96 geoid on a grid of 15' (egm96_15.gtx, of Debian's proj-data): below
/// PROJ_DATA, PROJ_LIB or /usr/share/proj; "" where it is not.
std::string find_egm96_grid();

/// Height of the geoid above the ellipsoid [m] from a grid in NOAA's GTX format (four big-endian
/// doubles: latitude and longitude of the lower left node, their spacings [degrees]; two integers:
/// rows, columns; then floats [m], row by row from the south), bilinear, all around the earth where
/// the grid is. The 15' grid of EGM96 is within 0.1 m of the model in most places. None: the place
/// is not on it. Throws Error that names a file that cannot be read.
std::optional<double> geoid_height_m(const std::string& gtx_file, double latitude_deg,
                                     double longitude_deg);

}  // namespace trident::sim
