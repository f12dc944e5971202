// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "logs/scan_map.h"

#include <cmath>

#include "front_end/beam_counts.h"

namespace trident {
namespace {

// Calls use(p_map_laser, p_map_end) for each return.
template <class Use>
void for_each_return(const PlacedScan& placed, double range_limit, const Use& use) {
  const LaserScan& scan = *placed.scan;
  const SE2 T_map_laser = placed.T_map_base * scan.T_base_laser;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double range = scan.ranges[i];
    if (!scan.is_return(i) || range > range_limit || range <= 0.0) continue;
    const double angle = scan.angle(i);
    use(T_map_laser.p,
        T_map_laser * Eigen::Vector2d(range * std::cos(angle), range * std::sin(angle)));
  }
}

}  // namespace

OccupancyGrid build_scan_map(std::size_t count,
                             const std::function<PlacedScan(std::size_t)>& placed_scan,
                             const ScanMapOptions& options) {
  Eigen::AlignedBox2d box;
  for (std::size_t k = 0; k < count; ++k) {
    for_each_return(placed_scan(k), options.range_limit,
                    [&](const Eigen::Vector2d& p_laser, const Eigen::Vector2d& p_end) {
                      box.extend(p_laser);
                      box.extend(p_end);
                    });
  }
  if (box.isEmpty()) return {};
  BeamCounts counts(box, options.resolution);
  for (std::size_t k = 0; k < count; ++k) {
    for_each_return(placed_scan(k), options.range_limit,
                    [&](const Eigen::Vector2d& p_laser, const Eigen::Vector2d& p_end) {
                      counts.add_beam(p_laser, p_end);
                    });
  }
  return counts.map(options.occupied_share);
}

}  // namespace trident
