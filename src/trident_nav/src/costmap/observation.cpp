// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/observation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::nav {
namespace {

/// Directions of the x and y axes of a laser that moves, in the costmap's frame.
struct LaserAxes {
  Eigen::Vector3d p, x, y;
};

LaserAxes axes_of(const Eigen::Quaterniond& R, const Eigen::Vector3d& p) {
  const Eigen::Matrix3d matrix = R.toRotationMatrix();
  return {p, matrix.col(0), matrix.col(1)};
}

/// `fraction` in [0, 1]: from the first pose to the last.
LaserAxes axes_between(Span<const SE3> poses, double fraction) {
  const double place = fraction * static_cast<double>(poses.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), poses.size() - 2);
  const double along = place - static_cast<double>(i);
  const SE3 &a = poses[i], &b = poses[i + 1];
  return axes_of(a.R.slerp(along, b.R), a.p + along * (b.p - a.p));
}

/// The length of a beam and whether it ends on something; a length of NaN: it says nothing.
struct BeamRange {
  double length_m;
  bool is_hit;
};

BeamRange beam_range(const LaserScan& scan, std::size_t beam, bool inf_is_valid) {
  const double range = scan.ranges[beam];
  // Some drivers say range_max, or more, where others say infinity.
  if (scan.is_return(beam) && range < scan.range_max) return {range, true};
  if (inf_is_valid && range >= scan.range_max) return {scan.range_max, false};
  return {std::numeric_limits<double>::quiet_NaN(), false};
}

bool has_legal_ranges(const LaserScan& scan) {
  return scan.range_min >= 0.0 && scan.range_max > scan.range_min && std::isfinite(scan.range_max);
}

}  // namespace

std::string scan_fault(const LaserScan& scan) {
  if (scan.ranges.empty()) return "the scan has no beam";
  if (!std::isfinite(scan.angle_min) || !std::isfinite(scan.angle_increment)) {
    return "angle_min and angle_increment of the scan must be finite";
  }
  if (!has_legal_ranges(scan)) {
    return "the scan's ranges go from range_min " + number_text(scan.range_min) +
           " m to range_max " + number_text(scan.range_max) +
           " m; 0 <= range_min < range_max is legal";
  }
  return {};
}

Observation observe_scan(const LaserScan& scan, Span<const SE3> T_costmap_laser,
                         bool inf_is_valid) {
  const std::string fault = scan_fault(scan);
  if (!fault.empty()) throw Error(fault);
  if (T_costmap_laser.empty()) throw Error("a scan needs at least one pose of its laser");
  const std::size_t beams = scan.size();
  const bool is_still = T_costmap_laser.size() == 1;
  Observation result;
  result.stamp_s = 1e-9 * static_cast<double>(scan.stamp_ns);
  result.ends.reserve(beams);
  LaserAxes axes = axes_of(T_costmap_laser[0].R, T_costmap_laser[0].p);
  for (std::size_t i = 0; i < beams; ++i) {
    const BeamRange range = beam_range(scan, i, inf_is_valid);
    if (std::isnan(range.length_m)) continue;
    if (!is_still) {
      const double span = beams > 1 ? static_cast<double>(beams - 1) : 1.0;
      axes = axes_between(T_costmap_laser, static_cast<double>(i) / span);
    }
    if (!is_still || result.groups.empty()) {
      result.groups.push_back({axes.p, result.ends.size(), 0});
    }
    const double angle = scan.angle(i);
    const Eigen::Vector3d along = std::cos(angle) * axes.x + std::sin(angle) * axes.y;
    result.ends.push_back({(range.length_m * along).cast<float>(), range.is_hit});
    ++result.groups.back().count;
  }
  return result;
}

Observation observe_points(double stamp_s, Span<const Eigen::Vector3f> p_sensor,
                           const SE3& T_costmap_sensor) {
  Observation result;
  result.stamp_s = stamp_s;
  result.ends.reserve(p_sensor.size());
  const Eigen::Matrix3f R = T_costmap_sensor.R.toRotationMatrix().cast<float>();
  for (const Eigen::Vector3f& p : p_sensor) {
    if (p.allFinite()) result.ends.push_back({R * p, true});
  }
  result.groups.push_back({T_costmap_sensor.p, 0, result.ends.size()});
  return result;
}

}  // namespace trident::nav
