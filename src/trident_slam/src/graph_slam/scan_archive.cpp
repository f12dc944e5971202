// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_slam/scan_archive.h"

#include <cmath>
#include <limits>

namespace trident {
namespace {

bool is_same_geometry(const LaserScan& a, const LaserScan& b, std::size_t beams_of_a) {
  return beams_of_a == b.size() && a.angle_min == b.angle_min &&
         a.angle_increment == b.angle_increment && a.time_increment == b.time_increment &&
         a.range_min == b.range_min && a.range_max == b.range_max &&
         a.T_base_laser.p == b.T_base_laser.p && a.T_base_laser.angle == b.T_base_laser.angle;
}

}  // namespace

void ScanArchive::add(const LaserScan& scan, const Entry& entry, double max_range) {
  if (geometries_.empty() ||
      !is_same_geometry(geometries_.back(), scan, geometries_.back().size())) {
    LaserScan geometry = scan;
    std::fill(geometry.ranges.begin(), geometry.ranges.end(), 0.0F);
    geometries_.push_back(std::move(geometry));
  }
  entries_.push_back(entry);
  entries_.back().geometry = static_cast<std::uint32_t>(geometries_.size() - 1);
  entries_.back().first_range = ranges_.size();
  const double limit = std::min(max_range, 65.0);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const bool is_kept =
        entry.is_used && scan.is_return(i) && static_cast<double>(scan.ranges[i]) < limit;
    ranges_.push_back(is_kept ? static_cast<std::uint16_t>(std::lround(1000.0F * scan.ranges[i]))
                              : 0);
  }
}

LaserScan ScanArchive::scan(std::size_t i) const {
  const Entry& entry = entries_[i];
  LaserScan scan = geometries_[entry.geometry];
  scan.stamp_ns = entry.stamp_ns;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const std::uint16_t range_mm = ranges_[entry.first_range + beam];
    scan.ranges[beam] = range_mm > 0 ? 0.001F * static_cast<float>(range_mm)
                                     : std::numeric_limits<float>::infinity();
  }
  return scan;
}

}  // namespace trident
