// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// A sweep that is taken while the robot turns, put right by odometry and by a gyro.
#include "trident_slam/sweep_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "graph_slam/polygon_world.h"
#include "trident_base/angle.h"
#include "trident_slam/graph_slam_2d.h"
#include "trident_slam/hector_slam_2d.h"
#include "trident_slam/particle_slam_2d.h"
#include "trident_slam/point_scan.h"

namespace trident::slam {
namespace {

constexpr double kBeamPeriod = 0.1 / 179.0;  // [s]: a tenth of a second per sweep
constexpr double kScanPeriod = 0.1;
constexpr std::int64_t kMs = 1'000'000;

PolygonWorld room() {
  PolygonWorld world;
  world.add_polygon({{-4, -3}, {4, -3}, {4, 1}, {5, 1}, {5, 3}, {-4, 3}});
  world.add_box(-2.0, 1.2, -1.2, 2.0);
  return world;
}

/// A sweep without noise, each beam from where the robot, moving with `twist`, is by then.
LaserScan swept(const PolygonWorld& world, const SE2& T_start, const Eigen::Vector3d& twist) {
  LaserScan scan = world.scan(T_start, 0, 0.0);
  scan.time_increment = kBeamPeriod;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const SE2 T = T_start * SE2::exp(twist * (kBeamPeriod * static_cast<double>(i)));
    scan.ranges[i] = world.scan(T, 0, 0.0).ranges[i];
  }
  return scan;
}

/// Largest distance of a sweep's points from where the room's surfaces are, seen from its start.
double distortion(const PolygonWorld& world, const SE2& T_start, const PointScan& points) {
  double largest = 0.0;
  for (const SurfacePoint& point : points.points) {
    const Eigen::Vector2d p = T_start * point.p.cast<double>();
    largest = std::max(largest, world.distance_to_wall(p));
  }
  return largest;
}

TEST(SweepTwist, ASweepTakenWhileTurningIsPutRight) {
  const PolygonWorld world = room();
  const SE2 start = SE2::from_xy_yaw(0.5, -0.3, 0.4);
  const Eigen::Vector3d truth(0.5, 0.0, 1.0);
  LaserScan scan = swept(world, start, truth);
  EXPECT_GT(distortion(world, start, make_point_scan(scan, {})), 0.2) << "untouched";
  const SE2 moved = SE2::exp(kScanPeriod * truth);
  const Eigen::Vector3d by_odometry = sweep_twist(scan, moved, kScanPeriod);
  EXPECT_LT((by_odometry - truth).norm(), 1e-9);
  EXPECT_LT(distortion(world, start, make_point_scan(scan, {}, by_odometry)), 1e-4);
  // Wheels that slip: odometry believes half of the turn, the gyro knows.
  const SE2 slipped = SE2::exp(kScanPeriod * Eigen::Vector3d(0.5, 0.0, 0.5));
  EXPECT_GT(
      distortion(world, start, make_point_scan(scan, {}, sweep_twist(scan, slipped, kScanPeriod))),
      0.1);
  scan.yaw_rate = 1.0;
  EXPECT_LT(
      distortion(world, start, make_point_scan(scan, {}, sweep_twist(scan, slipped, kScanPeriod))),
      0.005);
}

TEST(SweepTwist, WhatIsTakenAtOnceOrLongAfterIsLeftAsItIs) {
  LaserScan scan;
  scan.ranges.assign(10, 1.0F);
  const SE2 moved = SE2::from_xy_yaw(0.1, 0.0, 0.1);
  scan.yaw_rate = 1.0;
  EXPECT_TRUE(sweep_twist(scan, moved, 0.1).isZero(0.0)) << "no time between beams";
  scan.time_increment = 1e-3;
  EXPECT_DOUBLE_EQ(sweep_duration(scan), 9e-3);
  EXPECT_EQ(sweep_twist(scan, moved, 1.5), Eigen::Vector3d(0.0, 0.0, 1.0)) << "the gyro alone";
  EXPECT_EQ(sweep_twist(scan, moved, 0.0), Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ(sweep_twist(scan, moved, -0.1), Eigen::Vector3d(0.0, 0.0, 1.0));
  scan.yaw_rate.reset();
  EXPECT_TRUE(sweep_twist(scan, moved, 1.5).isZero(0.0));
}

TEST(YawRates, TheMeanIsTheIntegralOverTheTime) {
  YawRates rates;
  for (int i = 0; i <= 10; ++i) {  // 0.1 rad/s per 10 ms
    EXPECT_TRUE(rates.add(i * 10 * kMs, 0.1 * i));
  }
  EXPECT_NEAR(*rates.mean(0, 100 * kMs), 0.5, 1e-12);
  EXPECT_NEAR(*rates.mean(25 * kMs, 75 * kMs), 0.5, 1e-12) << "between samples";
  EXPECT_NEAR(*rates.mean(22 * kMs, 24 * kMs), 0.23, 1e-12) << "within one interval";
  EXPECT_NEAR(*rates.mean(35 * kMs, 35 * kMs), 0.35, 1e-12);
  EXPECT_EQ(*rates.newest_ns(), 100 * kMs);
}

TEST(YawRates, WhatIsNotMeasuredIsNotReported) {
  YawRates rates;
  EXPECT_FALSE(rates.mean(0, 10 * kMs));
  EXPECT_FALSE(rates.newest_ns());
  rates.add(0, 1.0);
  rates.add(50 * kMs, 1.0);
  EXPECT_TRUE(rates.mean(0, 50 * kMs));
  EXPECT_FALSE(rates.mean(10 * kMs, 51 * kMs)) << "beyond the newest";
  EXPECT_FALSE(rates.mean(-kMs, 10 * kMs)) << "before the oldest";
  EXPECT_FALSE(rates.mean(20 * kMs, 10 * kMs));
  rates.add(200 * kMs, 1.0);
  rates.add(210 * kMs, 1.0);
  EXPECT_FALSE(rates.mean(40 * kMs, 205 * kMs)) << "over a gap";
  EXPECT_FALSE(rates.mean(60 * kMs, 70 * kMs)) << "within a gap";
  EXPECT_TRUE(rates.mean(200 * kMs, 205 * kMs));
}

TEST(YawRates, BadSamplesAreLeftOutAndTimeMayStartAgain) {
  YawRates rates;
  EXPECT_TRUE(rates.add(5000 * kMs, 1.0));
  EXPECT_FALSE(rates.add(5010 * kMs, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(rates.add(5000 * kMs, 2.0)) << "the same stamp again";
  EXPECT_FALSE(rates.add(4990 * kMs, 2.0)) << "late";
  EXPECT_TRUE(rates.add(100 * kMs, 3.0)) << "a bag that is played again";
  EXPECT_EQ(*rates.newest_ns(), 100 * kMs);
  EXPECT_TRUE(rates.add(20'000 * kMs, 1.0));
  EXPECT_FALSE(rates.mean(100 * kMs, 100 * kMs)) << "only some seconds are kept";
}

/// A robot that turns to and fro at up to 1 rad/s; odometry sees nothing of it, a gyro does.
/// Returns the largest error of a pose's yaw [rad].
template <class Slam>
double largest_yaw_error(Slam& slam, bool has_gyro) {
  const PolygonWorld world = room();
  double largest = 0.0;
  SE2 T = SE2::identity();
  for (int k = 0; k < 40; ++k) {
    const double rate = std::sin(0.35 * k);
    LaserScan scan = swept(world, T, {0.0, 0.0, rate});
    scan.stamp_ns = k * 100 * kMs;
    if (has_gyro) scan.yaw_rate = rate;
    const ScanPose2d pose = slam.add_scan(scan, SE2::identity());
    largest = std::max(largest, std::abs(angle_difference(pose.T_map_base.angle, T.angle)));
    T = T * SE2::from_xy_yaw(0.0, 0.0, rate * kScanPeriod);
  }
  return largest;
}

TEST(SweepTwist, EachMethodTakesTheGyrosRate) {
  const auto errors = [](auto make) {
    const auto without = make();
    const auto with = make();
    return std::pair(largest_yaw_error(*without, false), largest_yaw_error(*with, true));
  };
  // Each matches to its map as well as it can; what the sweep itself is wrong by comes on top.
  const auto graph = errors([] { return std::make_unique<GraphSlam2d>(); });
  EXPECT_LT(graph.second, 0.01);
  EXPECT_GT(graph.first, 3.0 * graph.second);
  const auto hector = errors([] { return std::make_unique<HectorSlam2d>(); });
  EXPECT_LT(hector.second, 0.02);
  EXPECT_GT(hector.first, 3.0 * hector.second);
  const auto particles = errors([] { return std::make_unique<ParticleSlam2d>(); });
  EXPECT_LT(particles.second, 0.04);
  EXPECT_GT(particles.first, 1.5 * particles.second);
}

}  // namespace
}  // namespace trident::slam
