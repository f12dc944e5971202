// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_base/occupancy_grid.h"

namespace trident {

/// Writes `stem`.pgm and `stem`.yaml as map_saver does (trinary: 0 occupied, 254 free, 205 unknown;
/// the top row is the largest y). Occupied is from 65 %, free below 25 %. Throws Error when a file
/// cannot be written.
void write_map(const OccupancyGrid& map, const std::string& stem);

/// The bytes of that PGM.
std::string map_as_pgm(const OccupancyGrid& map);

}  // namespace trident
