// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "trident_base/laser_scan.h"
#include "trident_base/se3.h"
#include "trident_base/span.h"

namespace trident::nav {

/// Where a beam ends, from where it began, in the axes of the costmap's frame [m].
struct BeamEnd {
  Eigen::Vector3f p = Eigen::Vector3f::Zero();
  /// False: there is nothing up to here, and perhaps not beyond.
  bool is_hit = true;
};

/// Beams that began at one place in the costmap's frame [m].
struct BeamGroup {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::size_t first = 0;  ///< Of Observation::ends.
  std::size_t count = 0;
};

/// What one message of a source says: places that are free, and places that are not.
struct Observation {
  double stamp_s = 0.0;
  std::vector<BeamGroup> groups;
  std::vector<BeamEnd> ends;
};

/// What is wrong with a scan, as a whole sentence with the value and what is legal; empty when
/// nothing is: no beam, an angle or increment that is not finite, range_min or range_max negative,
/// not finite or in the wrong order.
std::string scan_fault(const LaserScan& scan);

/// The beams of a scan. `T_costmap_laser` are the laser's poses at equal distances in time from the
/// first beam to the last (one: it stood still): each beam gets the pose between its neighbors.
/// Ranges outside of [range_min, range_max) and those that are no number are left out; those that
/// are infinite, or just too large, do not with `inf_is_valid`: there is nothing up to range_max.
/// Throws Error with scan_fault(), or when there is no pose.
Observation observe_scan(const LaserScan& scan, Span<const SE3> T_costmap_laser, bool inf_is_valid);

/// The beams to points in a sensor's frame [m]; points that are not finite are left out.
Observation observe_points(double stamp_s, Span<const Eigen::Vector3f> p_sensor,
                           const SE3& T_costmap_sensor);

}  // namespace trident::nav
