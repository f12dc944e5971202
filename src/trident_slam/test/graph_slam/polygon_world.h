// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "trident_base/angle.h"
#include "trident_base/laser_scan.h"
#include "trident_base/random_stream.h"

namespace trident::slam {

/// Walls, and what a scanner of 180 beams over 270 degrees sees of them.
class PolygonWorld {
 public:
  void add_polygon(const std::vector<Eigen::Vector2d>& corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      walls_.emplace_back(corners[i], corners[(i + 1) % corners.size()]);
    }
  }
  void add_box(double x0, double y0, double x1, double y1) {
    add_polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
  }

  /// Noise of `sigma` [m] is that of sample `index`.
  LaserScan scan(const SE2& T_map_laser, std::uint64_t index, double sigma = 0.01) const {
    return scan(T_map_laser, index, sigma, -0.75 * kPi, 1.5 * kPi / 179.0, 180);
  }
  /// The same by a scanner of other beams.
  LaserScan scan(const SE2& T_map_laser, std::uint64_t index, double sigma, double angle_min,
                 double angle_increment, std::uint32_t beams) const {
    const RandomStream noise(7, "polygon_world");
    LaserScan result;
    result.stamp_ns = static_cast<std::int64_t>(index) * 100'000'000;
    result.angle_min = angle_min;
    result.angle_increment = angle_increment;
    result.range_min = 0.05;
    result.range_max = 20.0;
    for (std::uint32_t beam = 0; beam < beams; ++beam) {
      const double angle = T_map_laser.angle + result.angle(beam);
      const double range = nearest(T_map_laser.p, {std::cos(angle), std::sin(angle)});
      result.ranges.push_back(static_cast<float>(range + sigma * noise.normal(index, beam)));
    }
    return result;
  }

  double distance_to_wall(const Eigen::Vector2d& p) const {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : walls_) {
      const double part = (p - a).dot(b - a) / (b - a).squaredNorm();
      best = std::min(best, (p - a - std::min(std::max(part, 0.0), 1.0) * (b - a)).norm());
    }
    return best;
  }

 private:
  double nearest(const Eigen::Vector2d& from, const Eigen::Vector2d& direction) const {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : walls_) {
      const Eigen::Vector2d edge = b - a;
      const double det = edge.x() * direction.y() - edge.y() * direction.x();
      if (std::abs(det) < 1e-12) continue;
      const Eigen::Vector2d to = a - from;
      const double along_ray = (edge.x() * to.y() - edge.y() * to.x()) / det;
      const double along_wall = (direction.x() * to.y() - direction.y() * to.x()) / det;
      if (along_ray > 0.0 && along_wall >= 0.0 && along_wall <= 1.0) {
        best = std::min(best, along_ray);
      }
    }
    return best;
  }

  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> walls_;
};

/// A square corridor of 2 m about a block of 14 m, with niches so that no two places are alike.
inline PolygonWorld ring_world() {
  PolygonWorld world;
  world.add_box(0.0, 0.0, 18.0, 18.0);
  world.add_polygon({{2, 2},   {6, 2},   {6, 3},   {7, 3},   {7, 2},   {16, 2},    {16, 9},
                     {15, 9},  {15, 11}, {16, 11}, {16, 16}, {12, 16}, {12, 15.2}, {10, 15.2},
                     {10, 16}, {2, 16},  {2, 6},   {3.5, 6}, {3.5, 5}, {2, 5}});
  world.add_box(12.0, 0.0, 12.5, 0.4);
  world.add_box(17.5, 5.0, 18.0, 5.3);
  world.add_box(4.0, 17.4, 5.0, 18.0);
  world.add_box(0.0, 12.0, 0.4, 13.0);
  return world;
}

/// Poses every 0.1 m and 0.1 rad along so many sides of a rectangle, from `T` on with left turns.
/// Its sides are by turns `first` and `second` steps of 0.1 m long.
inline std::vector<SE2> rectangle_path(SE2 T, int first, int second, int sides) {
  std::vector<SE2> path;
  for (int side = 0; side < sides; ++side) {
    for (int i = 0; i < (side % 2 == 0 ? first : second); ++i) {
      path.push_back(T);
      T = T * SE2::from_xy_yaw(0.1, 0.0, 0.0);
    }
    for (int i = 0; i < 16; ++i) {
      path.push_back(T);
      T = T * SE2::from_xy_yaw(0.0, 0.0, 0.5 * kPi / 16.0);
    }
  }
  return path;
}

/// Poses along the ring's middle, `rounds` times.
inline std::vector<SE2> ring_path(double rounds) {
  return rectangle_path(SE2::from_xy_yaw(1.0, 1.0, 0.0), 160, 160, static_cast<int>(4.0 * rounds));
}

/// Odometry along a path whose distances and turns are wrong by these factors.
inline std::vector<SE2> drifting_odometry(const std::vector<SE2>& path, double distance_scale,
                                          double turn_scale) {
  std::vector<SE2> odometry = {SE2::identity()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const SE2 moved = path[i - 1].inverse() * path[i];
    odometry.push_back(odometry.back() * SE2::from_xy_yaw(distance_scale * moved.p.x(),
                                                          distance_scale * moved.p.y(),
                                                          turn_scale * moved.angle));
  }
  return odometry;
}

}  // namespace trident::slam
