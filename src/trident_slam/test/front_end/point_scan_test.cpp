// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Normals of scans, and what a scanner whose noise grows with the range makes of a corridor.
#include "trident_slam/point_scan.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "graph_slam/polygon_world.h"
#include "matchers/line_match.h"
#include "trident_base/angle.h"

namespace trident::slam {
namespace {

/// A corridor of 2.4 m along x with rooms on both sides, whose ends a scanner of 12 m does not see
/// from its middle: what it sees through the doors shows how far along it the robot is.
PolygonWorld corridor() {
  std::vector<Eigen::Vector2d> outline;
  const auto add_room = [&outline](double door, double side) {
    const Eigen::Vector2d corners[] = {{-0.5, 1.2}, {-0.5, 1.35}, {-1.6, 1.35}, {-1.6, 5.0},
                                       {1.9, 5.0},  {1.9, 1.35},  {0.5, 1.35},  {0.5, 1.2}};
    for (const Eigen::Vector2d& p : corners) {
      outline.emplace_back(door + side * p.x(), side * p.y());
    }
  };
  for (double door = -18.0; door < 19.0; door += 4.0) add_room(door, 1.0);
  for (double door = 17.0; door > -19.0; door -= 4.0) add_room(door, -1.0);
  PolygonWorld world;
  world.add_polygon(outline);
  return world;
}

/// What an RPLidar A1 sees: the spread of a range is a hundredth of it, 1 cm at least.
LaserScan seen(const PolygonWorld& world, const SE2& T, std::uint64_t index) {
  const RandomStream noise(7, "point_scan_test");
  LaserScan scan = world.scan(T, index, 0.0);
  scan.range_max = 12.0;
  for (std::uint32_t beam = 0; beam < scan.size(); ++beam) {
    const double range = scan.ranges[beam];
    const double spread = std::max(0.01, 0.01 * range);
    scan.ranges[beam] = static_cast<float>(range + spread * noise.normal(index, beam));
  }
  return scan;
}

TEST(PointScan, WallsOfANoisyScannerHaveNormals) {
  PolygonWorld world;
  world.add_box(-3.0, -2.0, 3.0, 2.0);
  std::size_t normals = 0;
  std::size_t points = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const SE2 T = SE2::from_xy_yaw(0.02 * static_cast<double>(i) - 1.0, 0.0, 0.0);
    for (const SurfacePoint& point : make_point_scan(world.scan(T, i, 0.035), {}).points) {
      ++points;
      if (point.has_normal()) ++normals;
    }
  }
  EXPECT_GT(static_cast<double>(normals), 0.98 * static_cast<double>(points));
}

TEST(PointScan, NormalsByCornersAreThoseOfOneWall) {
  const PolygonWorld world = corridor();
  int normals = 0;
  int leaning = 0;
  for (double x = -7.0; x < 7.0; x += 0.25) {
    const LaserScan scan = world.scan(SE2::from_xy_yaw(x, 0.0, 0.0), 0, 0.0);
    for (const SurfacePoint& point : make_point_scan(scan, {}).points) {
      if (!point.has_normal()) continue;
      ++normals;
      const double lean = std::min(std::abs(point.normal.x()), std::abs(point.normal.y()));
      if (lean > 0.01) ++leaning;
    }
  }
  ASSERT_GT(normals, 5000);
  EXPECT_LT(leaning, normals / 16);
}

/// Near to a wall the beams about one of them span less than three standard deviations of the
/// noise.
TEST(PointScan, NoisyWallHasNormals) {
  PolygonWorld world;
  world.add_box(-1.0, -1.0, 1.0, 1.0);
  int normals = 0;
  int right = 0;
  int points = 0;
  for (std::uint64_t k = 0; k < 20; ++k) {
    const LaserScan scan =
        world.scan(SE2::from_xy_yaw(0.02 * static_cast<double>(k), 0.1, 0.3), k, 0.03);
    for (const SurfacePoint& point : make_point_scan(scan, {}).points) {
      ++points;
      if (!point.has_normal()) continue;
      ++normals;
      const Eigen::Vector2d n = Eigen::Rotation2Dd(0.3) * point.normal.cast<double>();
      if (std::min(std::abs(n.x()), std::abs(n.y())) < 0.1) ++right;
    }
  }
  EXPECT_GT(normals, points * 3 / 4);
  EXPECT_GT(right, normals * 3 / 4);
}

/// Between two walls 45 cm from a scanner of 3 cm noise, the ends of three neighbouring beams lie
/// on a line along the beams as often as not.
TEST(PointScan, FewNoisyBeamsDoNotMakeAWallAcrossTheTrueOne) {
  const RandomStream noise(7, "point_scan_test");
  LaserScan scan;
  scan.angle_min = -0.5 * kPi;
  scan.angle_increment = kPi / 180.0;
  scan.range_max = 30.0;
  scan.ranges.resize(180);
  int normals = 0;
  int across = 0;
  for (std::uint64_t k = 0; k < 100; ++k) {
    for (std::uint32_t beam = 0; beam < scan.size(); ++beam) {
      const double angle = scan.angle_min + scan.angle_increment * beam;
      const double range = 0.45 / std::abs(std::sin(angle)) + 0.03 * noise.normal(k, beam);
      scan.ranges[beam] = static_cast<float>(range);
    }
    for (const SurfacePoint& point : make_point_scan(scan, {}).points) {
      if (!point.has_normal()) continue;
      ++normals;
      if (std::abs(point.normal.x()) > std::abs(point.normal.y())) ++across;
    }
  }
  ASSERT_GT(normals, 100 * 120);
  EXPECT_LT(across, normals / 100);
}

TEST(LineMatch, PointsBeyondTheReferenceHaveNoPair) {
  PointScan wall;
  PointScan longer;
  for (int i = 0; i < 41; ++i) {
    const SurfacePoint point{{0.05F * static_cast<float>(i), 1.0F}, {0.0F, -1.0F}};
    longer.points.push_back(point);
    if (i < 21) wall.points.push_back(point);
  }
  SurfelMap reference;
  reference.insert(SE2::identity(), wall);
  const MatchResult match = match_lines(reference, longer, SE2::identity(), {}, {});
  // The last surfel is the mean of the points at 0.9 to 1.0 m; 0.1 m from it two more are taken.
  EXPECT_NEAR(match.inlier_fraction, 23.0 / 41.0, 1.5 / 41.0);
}

TEST(LineMatch, CorridorIsNotStretchedByNoiseThatGrowsWithTheRange) {
  const PolygonWorld world = corridor();
  const SE2 T_step = SE2::from_xy_yaw(0.5, 0.0, 0.0);
  double sum = 0.0;
  double weights = 0.0;
  std::uint64_t index = 0;
  for (double x = -7.0; x < 7.0; x += 0.25) {
    const SE2 T = SE2::from_xy_yaw(x, 0.0, 0.0);
    for (int k = 0; k < 60; ++k) {
      SurfelMap reference;
      reference.insert(SE2::identity(), make_point_scan(seen(world, T, index++), {}));
      const PointScan scan = make_point_scan(seen(world, T * T_step, index++), {});
      const MatchResult match = match_lines(reference, scan, T_step, {}, {});
      sum += match.information(0, 0) * (match.T_ref_base.p.x() - T_step.p.x());
      weights += match.information(0, 0);
    }
  }
  EXPECT_NEAR(sum / weights, 0.0, 0.7e-3);
}

}  // namespace
}  // namespace trident::slam
