// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_map.h"

#include <cmath>
#include <vector>

#include "grids/beam_counts.h"

namespace trident::slam {
namespace {

// Where the returns of a scan lie [m].
std::vector<Eigen::Vector2d> returns(const LaserScan& scan, const SE2& T_map_laser,
                                     double range_limit) {
  std::vector<Eigen::Vector2d> ends;
  ends.reserve(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double range = scan.ranges[i];
    if (!scan.is_return(i) || range > range_limit || range <= 0.0) continue;
    const double angle = scan.angle(i);
    ends.emplace_back(T_map_laser *
                      Eigen::Vector2d(range * std::cos(angle), range * std::sin(angle)));
  }
  return ends;
}

}  // namespace

OccupancyGrid build_scan_map(std::size_t count,
                             const std::function<PlacedScan(std::size_t)>& placed_scan,
                             const ScanMapOptions& options) {
  BeamCounts counts(options.resolution);
  for (std::size_t k = 0; k < count; ++k) {
    const PlacedScan placed = placed_scan(k);
    const SE2 T_map_laser = placed.T_map_base * placed.scan->T_base_laser;
    counts.add_beams(T_map_laser.p, returns(*placed.scan, T_map_laser, options.range_limit));
  }
  return counts.map();
}

}  // namespace trident::slam
