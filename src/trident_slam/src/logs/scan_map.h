// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "trident_base/laser_scan.h"
#include "trident_base/occupancy_grid.h"
#include "trident_base/se2.h"

namespace trident::slam {

/// One scan and where its base was.
struct PlacedScan {
  const LaserScan* scan = nullptr;
  SE2 T_map_base;
};

struct ScanMapOptions {
  double resolution = 0.05;   ///< [m]
  double range_limit = 80.0;  ///< [m]
};

/// The map of scans at given poses by counting their beams. Returns beyond `range_limit` are left
/// out; beams without a return clear nothing. Throws Error when the map would have more than 2^28
/// cells.
OccupancyGrid build_scan_map(std::size_t count,
                             const std::function<PlacedScan(std::size_t)>& placed_scan,
                             const ScanMapOptions& options);

}  // namespace trident::slam
