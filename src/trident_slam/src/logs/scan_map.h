// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "trident_base/laser_scan.h"
#include "trident_base/occupancy_grid.h"
#include "trident_base/se2.h"

namespace trident {

/// One scan and where its base was.
struct PlacedScan {
  const LaserScan* scan = nullptr;
  SE2 T_map_base;
};

/// The map of scans at given poses by counting, for each cell, beams that ended in it and beams
/// that went through it (the reflection map of Thrun, Burgard, Fox: Probabilistic Robotics, 9.3).
/// A cell is occupied where at least `occupied_share` of at least two beams ended. Returns beyond
/// `range_limit` [m] are left out; beams without a return clear nothing.
struct ScanMapOptions {
  double resolution = 0.05;      ///< [m]
  double range_limit = 80.0;     ///< [m]
  double occupied_share = 0.25;  ///< of the beams that touched the cell
};

/// Throws Error when the map would have more than 2^28 cells.
OccupancyGrid build_scan_map(std::size_t count,
                             const std::function<PlacedScan(std::size_t)>& placed_scan,
                             const ScanMapOptions& options);

}  // namespace trident
