// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/point_scan.h"

#include <algorithm>
#include <cmath>

namespace trident {
namespace {

/// Beams to each side that take part in the line of a normal: at least so many, and as many more
/// as lie within the reach. Close to a wall few beams would span less than the scanner's noise.
constexpr int kFewestNeighbours = 3;
constexpr int kMostNeighbours = 24;
constexpr float kReach = 0.15F;  // [m]

/// Neighbouring beams meet one surface if the gap between their ends is at most this [m]. A wall
/// seen at 10 degrees of grazing angle stays in one piece.
double largest_gap(double range, double angle_increment) {
  return 0.05 + 6.0 * range * std::abs(angle_increment);
}

/// Sums over the points of one line.
struct LineSums {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(const Eigen::Vector2f& p, const Eigen::Vector2f& about) {
    const double dx = static_cast<double>(p.x()) - static_cast<double>(about.x());
    const double dy = static_cast<double>(p.y()) - static_cast<double>(about.y());
    n += 1.0;
    x += dx;
    y += dy;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
};

/// The normal of the least-squares line, or zero if the points do not lie on one.
Eigen::Vector2f line_normal(const LineSums& s) {
  if (s.n < 3.0) return Eigen::Vector2f::Zero();
  const double cxx = s.xx / s.n - s.x * s.x / (s.n * s.n);
  const double cxy = s.xy / s.n - s.x * s.y / (s.n * s.n);
  const double cyy = s.yy / s.n - s.y * s.y / (s.n * s.n);
  const double half_trace = 0.5 * (cxx + cyy);
  const double root = std::sqrt(0.25 * (cxx - cyy) * (cxx - cyy) + cxy * cxy);
  const double across = std::max(half_trace - root, 0.0);
  const double along = half_trace + root;
  constexpr double kThickest = 0.04;  // [m], standard deviation across the line
  if (across > kThickest * kThickest || across > 0.1 * along) return Eigen::Vector2f::Zero();
  const double angle = 0.5 * std::atan2(2.0 * cxy, cxx - cyy);  // of the line
  return {static_cast<float>(-std::sin(angle)), static_cast<float>(std::cos(angle))};
}

struct Return {
  std::size_t beam;
  double range;
};

void set_normals(const std::vector<Return>& returns, double angle_increment, PointScan* scan) {
  const int size = static_cast<int>(scan->points.size());
  for (int i = 0; i < size; ++i) {
    SurfacePoint& point = scan->points[i];
    LineSums sums;
    sums.add(point.p, point.p);
    for (const int side : {-1, 1}) {
      for (int k = 1; k <= kMostNeighbours; ++k) {
        const int j = i + side * k;
        if (j < 0 || j >= size) break;
        const int before = j - side;
        const double gap = static_cast<double>((scan->points[j].p - scan->points[before].p).norm());
        if (gap > largest_gap(returns[before].range, angle_increment)) break;
        if (k > kFewestNeighbours && (scan->points[j].p - point.p).norm() > kReach) break;
        sums.add(scan->points[j].p, point.p);
      }
    }
    point.normal = line_normal(sums);
    if (point.normal.dot(scan->origin - point.p) < 0.0F) point.normal = -point.normal;
  }
}

}  // namespace

PointScan make_point_scan(const LaserScan& scan, const PointScanOptions& options,
                          const Eigen::Vector3d& twist) {
  PointScan result;
  result.origin = scan.T_base_laser.p.cast<float>();
  const double nearest = std::max(options.min_range, scan.range_min);
  const double farthest = std::min(options.max_range, scan.range_max);
  const bool is_rolling = scan.time_increment != 0.0 && !twist.isZero(0.0);
  std::vector<Return> returns;
  returns.reserve(scan.size());
  result.points.reserve(scan.size());
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double range = static_cast<double>(scan.ranges[beam]);
    if (!(range > 0.0 && range >= nearest && range <= farthest)) continue;  // NaN, too
    const double angle = scan.angle(beam);
    Eigen::Vector2d p =
        scan.T_base_laser * Eigen::Vector2d(range * std::cos(angle), range * std::sin(angle));
    if (is_rolling) p = SE2::exp(twist * (scan.time_increment * static_cast<double>(beam))) * p;
    returns.push_back({beam, range});
    result.points.push_back({p.cast<float>(), Eigen::Vector2f::Zero()});
  }
  set_normals(returns, scan.angle_increment, &result);
  return result;
}

}  // namespace trident
