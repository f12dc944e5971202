// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/control/moving_obstacles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "trident_base/angle.h"
#include "trident_nav/control/controller.h"

namespace trident::nav {
namespace {

constexpr double kPeriod_s = 0.1;
constexpr double kWalkerRadius_m = 0.25;

/// A walker who crosses before the robot from the right, at 2 m before it.
Point2 walker_at(double time_s) { return {2.0, -1.5 + 1.0 * time_s}; }

/// Where the laser is: it stands, or drives forward and turns.
SE3 laser_at(double time_s, bool is_driving) {
  SE3 pose;
  pose.p = {is_driving ? 0.2 * time_s : 0.0, 0.0, 0.2};
  const double yaw = is_driving ? 0.5 * time_s : 0.0;
  pose.R = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  return pose;
}

double range_to_walker(const Point2& walker, const Point2& from, double angle) {
  const double dx = walker.x - from.x, dy = walker.y - from.y;
  const double c = std::cos(angle), s = std::sin(angle);
  const double along = dx * c + dy * s, across = dx * s - dy * c;
  const double square = kWalkerRadius_m * kWalkerRadius_m - across * across;
  return along <= 0.0 || square < 0.0 ? INFINITY : along - std::sqrt(square);
}

/// A scan of one turn that takes 0.1 s, among a wall at x = 4 m and the walker.
LaserScan scan_at(double time_s, bool is_driving) {
  constexpr int kBeams = 360;
  LaserScan scan;
  scan.angle_increment = 2.0 * kPi / kBeams;
  scan.time_increment = kPeriod_s / kBeams;
  scan.range_min = 0.1;
  scan.range_max = 12.0;
  for (std::size_t i = 0; i < kBeams; ++i) {
    const double at_s = time_s + scan.time_increment * static_cast<double>(i);
    const SE3 pose = laser_at(at_s, is_driving);
    const double angle = scan.angle(i) + pose.rpy().z();
    const double c = std::cos(angle);
    const double wall = c > 0.0 ? (4.0 - pose.p.x()) / c : INFINITY;
    const double range =
        std::min(wall, range_to_walker(walker_at(at_s), {pose.p.x(), pose.p.y()}, angle));
    scan.ranges.push_back(static_cast<float>(range));
  }
  return scan;
}

void add_scan(MovingObstacles* obstacles, double time_s, bool is_driving,
              const std::string& source = "scan") {
  const std::vector<SE3> poses = {laser_at(time_s, is_driving),
                                  laser_at(time_s + kPeriod_s, is_driving)};
  obstacles->add_scan(source, time_s, scan_points(scan_at(time_s, is_driving), poses, {}));
}

class AWalkerCrosses : public ::testing::TestWithParam<bool> {};

TEST_P(AWalkerCrosses, AndIsTrackedWhereItWalksTo) {
  MovingObstacles obstacles;
  double time_s = 0.0;
  for (; time_s < 1.45; time_s += kPeriod_s) add_scan(&obstacles, time_s, GetParam());
  const Tracks tracks = obstacles.at(time_s);
  ASSERT_EQ(tracks.size(), 1U) << "the wall stands";
  const Point2 truth = walker_at(time_s);
  EXPECT_NEAR(tracks[0].position.x, truth.x, 0.2);
  EXPECT_NEAR(tracks[0].position.y, truth.y, 0.2);
  EXPECT_NEAR(tracks[0].velocity.x, 0.0, 0.25);
  EXPECT_NEAR(tracks[0].velocity.y, 1.0, 0.25);
}

INSTANTIATE_TEST_SUITE_P(Robot, AWalkerCrosses, ::testing::Bool(), [](const auto& driving) {
  return driving.param ? "ThatDrives" : "ThatStands";
});

TEST(MovingObstacles, NothingIsTrackedWhereItIsSwitchedOff) {
  MovingObstacleParams params;
  params.enabled = false;
  MovingObstacles obstacles(params);
  obstacles.set_reported({Track{}}, 0.0);
  for (int i = 0; i < 15; ++i) add_scan(&obstacles, 0.1 * i, false);
  EXPECT_TRUE(obstacles.at(1.5).empty());
}

TEST(MovingObstacles, TwoSourcesHaveIdsOfTheirOwn) {
  MovingObstacles obstacles;
  for (int i = 0; i < 15; ++i) {
    add_scan(&obstacles, 0.1 * i, false, "front");
    add_scan(&obstacles, 0.1 * i, false, "back");
  }
  Track reported;
  reported.id = 1;
  obstacles.set_reported({reported}, 1.4);
  std::set<int> ids;
  for (const Track& track : obstacles.at(1.5)) ids.insert(track.id);
  EXPECT_EQ(ids.size(), 3U);
}

TEST(MovingObstacles, WhatIsReportedMovesOnAndIsForgotten) {
  MovingObstacles obstacles;
  Track track;
  track.position = {1.0, 2.0};
  track.velocity = {0.5, -1.0};
  obstacles.set_reported({track}, 10.0);
  const Tracks soon = obstacles.at(10.4);
  ASSERT_EQ(soon.size(), 1U);
  EXPECT_DOUBLE_EQ(soon[0].position.x, 1.2);
  EXPECT_DOUBLE_EQ(soon[0].position.y, 1.6);
  EXPECT_TRUE(obstacles.at(11.5).empty());
}

TEST(ScanPoints, OfWhatIsTooHighOrNotThereEndNowhere) {
  LaserScan scan;
  scan.angle_increment = 0.5 * kPi;
  scan.range_min = 0.1;
  scan.range_max = 5.0;
  scan.ranges = {1.0F, INFINITY, NAN, 5.0F};
  SE3 pose;
  pose.p = {1.0, 0.0, 0.5};
  const ScanPoints low = scan_points(scan, std::vector<SE3>{pose}, {0.0, 2.0});
  EXPECT_TRUE(low.is_full_turn);
  EXPECT_DOUBLE_EQ(low.ends[0].x, 2.0);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_TRUE(std::isnan(low.ends[i].x)) << i;
  const ScanPoints high = scan_points(scan, std::vector<SE3>{pose}, {1.0, 2.0});
  EXPECT_TRUE(std::isnan(high.ends[0].x));
}

}  // namespace
}  // namespace trident::nav
