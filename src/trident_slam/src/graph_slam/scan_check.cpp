// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_slam/scan_check.h"

#include <cmath>

#include "trident_base/string_util.h"

namespace trident {
namespace {

struct ReturnCounts {
  std::size_t usable = 0, not_a_number = 0, infinite = 0, zero = 0;
};

ReturnCounts count_returns(const LaserScan& scan) {
  ReturnCounts counts;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const float range = scan.ranges[i];
    if (std::isnan(range)) {
      ++counts.not_a_number;
    } else if (std::isinf(range)) {
      ++counts.infinite;
    } else if (range <= 0.0F) {
      ++counts.zero;
    } else if (scan.is_return(i)) {
      ++counts.usable;
    }
  }
  return counts;
}

std::string too_few(const LaserScan& scan, const ReturnCounts& counts) {
  return std::to_string(counts.usable) + " of " + std::to_string(scan.size()) +
         " beams have a return within [" + number_text(scan.range_min) + ", " +
         number_text(scan.range_max) + "] m, needed: " + std::to_string(ScanCheck::kFewestReturns) +
         " (" + std::to_string(counts.not_a_number) + " NaN, " + std::to_string(counts.infinite) +
         " infinite, " + std::to_string(counts.zero) + " zero)";
}

}  // namespace

bool ScanCheck::Geometry::operator==(const Geometry& other) const {
  return beams == other.beams && std::abs(angle_min - other.angle_min) < 1e-3 &&
         std::abs(angle_increment - other.angle_increment) < 1e-6;
}

std::string ScanCheck::problem(const LaserScan& scan) {
  const Geometry geometry{scan.size(), scan.angle_min, scan.angle_increment};
  if (!std::isfinite(scan.angle_min) || !std::isfinite(scan.angle_increment) ||
      scan.angle_increment == 0.0 || !std::isfinite(scan.T_base_laser.angle) ||
      !scan.T_base_laser.p.allFinite()) {
    return "angle_min " + number_text(scan.angle_min) + ", angle_increment " +
           number_text(scan.angle_increment) + " or the laser's place is not a usable number";
  }
  if (has_geometry_ && !(geometry == geometry_)) {
    changed_in_a_row_ = geometry == changed_ ? changed_in_a_row_ + 1 : 1;
    changed_ = geometry;
    if (changed_in_a_row_ < kPatience) {
      return std::to_string(scan.size()) + " beams from " + number_text(scan.angle_min) + " by " +
             number_text(scan.angle_increment) +
             " rad, so far: " + std::to_string(geometry_.beams) + " from " +
             number_text(geometry_.angle_min) + " by " + number_text(geometry_.angle_increment);
    }
  }
  changed_in_a_row_ = 0;
  geometry_ = geometry;
  has_geometry_ = true;
  const ReturnCounts counts = count_returns(scan);
  return counts.usable < kFewestReturns ? too_few(scan, counts) : std::string();
}

}  // namespace trident
