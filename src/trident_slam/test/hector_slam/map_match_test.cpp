// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "matchers/map_match.h"

#include <gtest/gtest.h>

#include <cmath>

#include "conformance/scan_world.h"
#include "trident_base/random_stream.h"

namespace trident::slam {
namespace {

using testing_world::ScanWorld;

PointScan points_of(std::size_t step) {
  static const ScanWorld world(4);
  return make_point_scan(world.steps()[step].scan, {});
}

/// The gradient of a bilinear surface jumps at the lines through the centres of cells: places are
/// kept clear of them.
Eigen::Vector2f inside_a_patch(const Eigen::Vector2f& p, float resolution) {
  const auto inside = [resolution](float v) {
    const float cell = std::floor(v / resolution - 0.5F);
    const float part = std::min(std::max(v / resolution - 0.5F - cell, 0.1F), 0.9F);
    return (cell + 0.5F + part) * resolution;
  };
  return {inside(p.x()), inside(p.y())};
}

TEST(ProbabilityGrid, GradientIsThatOfTheValue) {
  ProbabilityGrid map(0.1, 0.4, 0.9);
  const PointScan scan = points_of(0);
  map.insert(SE2::identity(), scan);
  const RandomStream random(3, "places");
  constexpr float h = 1e-3F;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Eigen::Vector2f near = scan.points[i % scan.points.size()].p;
    const Eigen::Vector2f p =
        inside_a_patch(near + Eigen::Vector2f(static_cast<float>(0.1 * random.normal(i, 0)),
                                              static_cast<float>(0.1 * random.normal(i, 1))),
                       0.1F);
    const auto value = [&](float dx, float dy) {
      return map.sample(p + Eigen::Vector2f(dx, dy)).value;
    };
    const Eigen::Vector2f numeric((value(h, 0) - value(-h, 0)) / (2 * h),
                                  (value(0, h) - value(0, -h)) / (2 * h));
    EXPECT_LT((map.sample(p).gradient - numeric).norm(), 2e-2F) << i;
  }
}

TEST(ProbabilityGrid, WallsAreOccupiedAndWhatBeamsPassedIsFree) {
  ProbabilityGrid map(0.05, 0.4, 0.9);
  PointScan scan;
  scan.points.push_back({{2.02F, 0.02F}, {}});
  map.insert(SE2::identity(), scan);
  EXPECT_GT(map.sample({2.025F, 0.025F}).value, 0.85F);
  EXPECT_NEAR(map.sample({1.025F, 0.025F}).value, 0.4F, 1e-5);
  EXPECT_EQ(map.sample({1.025F, 1.025F}).value, 0.5F);
  for (int i = 0; i < 4; ++i) map.insert(SE2::identity(), scan);
  const OccupancyGrid grid = map.occupancy();
  const Eigen::Vector2i wall = grid.cell_at({2.025, 0.025});
  const Eigen::Vector2i floor = grid.cell_at({1.025, 0.025});
  EXPECT_EQ(grid.cells[grid.index(wall.x(), wall.y())], OccupancyGrid::kOccupied);
  EXPECT_EQ(grid.cells[grid.index(floor.x(), floor.y())], OccupancyGrid::kFree);
}

TEST(MapMatch, TheStepIsTheGradientOfTheCost) {
  ProbabilityGrid map(0.2, 0.4, 0.9);
  map.insert(SE2::identity(), points_of(0));
  PointScan scan = points_of(0);
  const SE2 at = SE2::from_xy_yaw(0.03, -0.05, 0.02);
  // Points whose patch does not change within the difference.
  PointScan kept;
  constexpr double h = 1e-4;
  for (const SurfacePoint& point : scan.points) {
    const Eigen::Vector2f p = (at * point.p.cast<double>()).cast<float>();
    if ((inside_a_patch(p, 0.2F) - p).norm() < 1e-6F) kept.points.push_back(point);
  }
  ASSERT_GT(kept.points.size(), 50U);
  const auto cost = [&](double dx, double dy, double yaw) {
    return map_match_sums(map, kept, SE2::from_xy_yaw(at.p.x() + dx, at.p.y() + dy, at.angle + yaw))
        .cost;
  };
  const Eigen::Vector3d numeric((cost(h, 0, 0) - cost(-h, 0, 0)) / (2 * h),
                                (cost(0, h, 0) - cost(0, -h, 0)) / (2 * h),
                                (cost(0, 0, h) - cost(0, 0, -h)) / (2 * h));
  const Eigen::Vector3d g = map_match_sums(map, kept, at).g;  // half the cost's, and downwards
  EXPECT_LT((numeric + 2.0 * g).norm(), 0.02 * numeric.norm());
}

TEST(MapMatch, ReturnsFromAWrongGuess) {
  ProbabilityGrid map(0.1, 0.4, 0.9);
  map.insert(SE2::identity(), points_of(0));
  map.insert(SE2::identity(), points_of(0));
  const MapMatch match = match_map(map, points_of(0), SE2::from_xy_yaw(0.06, -0.05, 0.02), 15);
  EXPECT_LT(match.T_map_base.p.norm(), 0.02);
  EXPECT_LT(std::abs(match.T_map_base.angle), 0.005);
  EXPECT_GT(match.covariance.diagonal().minCoeff(), 0.0);
}

TEST(MapMatch, AnEmptyMapKeepsTheGuess) {
  const ProbabilityGrid map(0.1, 0.4, 0.9);
  const SE2 guess = SE2::from_xy_yaw(1.0, 2.0, 0.5);
  const MapMatch match = match_map(map, points_of(0), guess, 5);
  EXPECT_EQ(match.T_map_base.p, guess.p);
  EXPECT_TRUE(match.covariance.allFinite());
}

TEST(MapMatch, AlongACorridorTheGuessIsKept) {
  ProbabilityGrid map(0.1, 0.4, 0.9);
  PointScan corridor;
  for (int i = -100; i <= 100; ++i) {
    corridor.points.push_back({{0.05F * static_cast<float>(i), 1.05F}, {}});
    corridor.points.push_back({{0.05F * static_cast<float>(i), -0.95F}, {}});
  }
  map.insert(SE2::identity(), corridor);
  map.insert(SE2::identity(), corridor);
  PointScan middle;  // what is seen of it, far from both ends
  for (const SurfacePoint& point : corridor.points) {
    if (std::abs(point.p.x()) < 3.0F) middle.points.push_back(point);
  }
  const MapMatch match = match_map(map, middle, SE2::from_xy_yaw(0.5, 0.04, 0.0), 10);
  EXPECT_NEAR(match.T_map_base.p.x(), 0.5, 0.02);
  EXPECT_NEAR(match.T_map_base.p.y(), 0.0, 0.02);
  EXPECT_GT(match.covariance(0, 0), 100.0 * match.covariance(1, 1));
}

}  // namespace
}  // namespace trident::slam
