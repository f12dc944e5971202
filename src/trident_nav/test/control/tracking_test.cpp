// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/random_stream.h"
#include "trident_nav/control/obstacle_tracker.h"
#include "trident_nav/control/scan_clusters.h"

namespace trident::nav {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Disc {
  Point2 center;
  double radius_m;
};

// Along a ray of unit direction to a disc; nothing if it misses.
std::optional<double> range_to(const Disc& disc, const Point2& from, double c, double s) {
  const double dx = disc.center.x - from.x;
  const double dy = disc.center.y - from.y;
  const double along = dx * c + dy * s;
  const double square = disc.radius_m * disc.radius_m - (dx * dx + dy * dy - along * along);
  if (along <= 0.0 || square < 0.0) return std::nullopt;
  return along - std::sqrt(square);
}

// Beams all around; discs, and a wall at y = wall_y (NaN: none).
ScanPoints scan_of(const std::vector<Disc>& discs, const Point2& sensor, double wall_y = kNaN,
                   int beams = 720) {
  constexpr double kReach = 10.0;
  ScanPoints scan{sensor, 2.0 * kPi / beams, true, {}};
  for (int i = 0; i < beams; ++i) {
    const double c = std::cos(scan.angle_increment * i);
    const double s = std::sin(scan.angle_increment * i);
    double range = kReach;
    for (const Disc& disc : discs) {
      if (const auto r = range_to(disc, sensor, c, s)) range = std::min(range, *r);
    }
    const double to_wall = (wall_y - sensor.y) / s;
    if (to_wall > 0.0) range = std::min(range, to_wall);
    const Point2 end{sensor.x + range * c, sensor.y + range * s};
    scan.ends.push_back(range < kReach ? end : Point2{kNaN, kNaN});
  }
  return scan;
}

ScanCluster seen(double x, double y) { return {{x, y}, 0.2, 10, false}; }

TEST(ScanClusters, ADiscIsFoundWhereItIsWhereverTheScanBegins) {
  ScanClusterer clusterer({});
  for (const double bearing : {0.0, 0.5, 1.6, 3.1, -2.0}) {
    const Disc disc{{2.0 * std::cos(bearing), 2.0 * std::sin(bearing)}, 0.25};
    const auto& clusters = clusterer.cluster(scan_of({disc}, {0.0, 0.0}));
    ASSERT_EQ(clusters.size(), 1U) << bearing;
    EXPECT_NEAR(clusters[0].center.x, disc.center.x, 0.4 * disc.radius_m);
    EXPECT_NEAR(clusters[0].center.y, disc.center.y, 0.4 * disc.radius_m);
    EXPECT_NEAR(clusters[0].radius_m, disc.radius_m, 0.03);
    EXPECT_FALSE(clusters[0].is_partial);
  }
}

TEST(ScanClusters, WhatIsHiddenInPartIsMarked) {
  ScanClusterer clusterer({});
  const auto& clusters =
      clusterer.cluster(scan_of({{{1.0, 0.0}, 0.1}, {{3.0, 0.3}, 0.3}}, {0.0, 0.0}));
  ASSERT_EQ(clusters.size(), 2U);
  int partial = 0;
  for (const ScanCluster& cluster : clusters) {
    partial += cluster.is_partial ? 1 : 0;
    EXPECT_EQ(cluster.is_partial, cluster.center.x > 2.0);
  }
  EXPECT_EQ(partial, 1);
}

TEST(ScanClusters, WallsAreNoObjects) {
  ScanClusterer clusterer({});
  EXPECT_TRUE(clusterer.cluster(scan_of({}, {0.0, 0.0}, 1.5)).empty());
}

TEST(ScanClusters, BadScansAreRefusedByField) {
  ScanClusterer clusterer({});
  ScanPoints scan = scan_of({}, {0.0, 0.0});
  scan.angle_increment = 0.0;
  EXPECT_THROW(clusterer.cluster(scan), Error);
  scan = scan_of({}, {0.0, 0.0});
  scan.sensor.x = kNaN;
  EXPECT_THROW(clusterer.cluster(scan), Error);
  EXPECT_TRUE(clusterer.cluster({{0.0, 0.0}, 0.01, false, {}}).empty());
}

// The same filter with matrices.
struct DenseFilter {
  Eigen::Vector4d state = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();

  void step(double dt, double density, const Eigen::Vector2d& measured, double variance) {
    Eigen::Matrix4d f = Eigen::Matrix4d::Identity();
    Eigen::Matrix4d q = Eigen::Matrix4d::Zero();
    for (int axis = 0; axis < 2; ++axis) {
      f(axis, axis + 2) = dt;
      q(axis, axis) = density * dt * dt * dt / 3.0;
      q(axis, axis + 2) = q(axis + 2, axis) = 0.5 * density * dt * dt;
      q(axis + 2, axis + 2) = density * dt;
    }
    state = f * state;
    covariance = f * covariance * f.transpose() + q;
    const Eigen::Matrix<double, 2, 4> h = Eigen::Matrix4d::Identity().topRows<2>();
    const Eigen::Matrix2d s =
        h * covariance * h.transpose() + variance * Eigen::Matrix2d::Identity();
    const Eigen::Matrix<double, 4, 2> k = covariance * h.transpose() * s.inverse();
    state += k * (measured - h * state);
    covariance -= k * h * covariance;
  }
};

TEST(ObstacleTracker, TheFilterIsThatOfTheMatrices) {
  const TrackerParams params;
  ObstacleTracker tracker(params);
  DenseFilter dense;
  const double variance = params.position_noise * params.position_noise;
  dense.covariance.diagonal() << variance, variance, 1.0, 1.0;
  tracker.update({seen(0.0, 0.0)}, 0.0);
  for (int i = 1; i <= 30; ++i) {
    const double x = 0.06 * i + 0.01 * std::sin(i);
    const double y = -0.03 * i;
    tracker.update({seen(x, y)}, 0.1 * i);
    dense.step(0.1, params.acceleration_noise * params.acceleration_noise, {x, y}, variance);
  }
  const Tracks tracks = tracker.moving_at(3.0);
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_NEAR(tracks[0].position.x, dense.state[0], 1e-9);
  EXPECT_NEAR(tracks[0].position.y, dense.state[1], 1e-9);
  EXPECT_NEAR(tracks[0].velocity.x, dense.state[2], 1e-9);
  EXPECT_NEAR(tracks[0].velocity.y, dense.state[3], 1e-9);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      EXPECT_NEAR(tracks[0].covariance[static_cast<std::size_t>(4 * row + column)],
                  dense.covariance(row, column), 1e-12);
    }
  }
}

TEST(ObstacleTracker, ErrorsAreAsLargeAsTheCovarianceSays) {
  const TrackerParams params;
  const RandomStream random(5, "walkers");
  constexpr int kRuns = 300;
  constexpr double kStep = 0.1;
  double squared = 0.0;
  int count = 0;
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    ObstacleTracker tracker(params);
    Point2 position{0.0, 0.0};
    Point2 velocity{0.8 * random.normal(run, 0), 0.8 * random.normal(run, 1)};
    const double diffusion = params.acceleration_noise * std::sqrt(kStep);
    for (std::uint32_t i = 0; i < 40; ++i) {
      const double mx = position.x + params.position_noise * random.normal(run, 4 * i + 2);
      const double my = position.y + params.position_noise * random.normal(run, 4 * i + 3);
      tracker.update({seen(mx, my)}, kStep * i);
      if (i == 39) break;
      position.x += kStep * velocity.x;
      position.y += kStep * velocity.y;
      velocity.x += diffusion * random.normal(run, 4 * i + 4);
      velocity.y += diffusion * random.normal(run, 4 * i + 5);
    }
    for (const Track& track : tracker.moving_at(39 * kStep)) {
      const double ex = track.velocity.x - velocity.x;
      const double ey = track.velocity.y - velocity.y;
      squared += (ex * ex + ey * ey) / track.covariance[10];
      ++count;
    }
  }
  ASSERT_GT(count, kRuns / 2);
  // Of two dimensions; the mean of so many lies within.
  EXPECT_NEAR(squared / count, 2.0, 0.6);
}

TEST(ObstacleTracker, AWalkerMovesAndAPillarDoesNotThoughTheRobotDoes) {
  ScanClusterer clusterer({});
  ObstacleTracker tracker({});
  int id = 0;
  for (int i = 0; i < 60; ++i) {
    const double t = 0.1 * i;
    const Point2 sensor{0.5 * t, 0.0};
    const std::vector<Disc> discs = {
        {{4.0, 1.0}, 0.15}, {{2.0, -1.2}, 0.1}, {{6.0 - 0.8 * t, 2.2}, 0.25}};
    tracker.update(clusterer.cluster(scan_of(discs, sensor, 3.5)), t);
    const Tracks& moving = tracker.moving_at(t);
    ASSERT_LE(moving.size(), 1U) << "at " << t << " s";
    if (i < 20) continue;
    if (moving.empty()) continue;
    if (id == 0) id = moving[0].id;
    EXPECT_EQ(moving[0].id, id);
    EXPECT_NEAR(moving[0].velocity.x, -0.8, 0.35) << "at " << t << " s";
    EXPECT_NEAR(moving[0].velocity.y, 0.0, 0.35) << "at " << t << " s";
    EXPECT_NEAR(moving[0].position.x, discs[2].center.x, 0.2);
    EXPECT_NEAR(moving[0].position.y, discs[2].center.y, 0.2);
  }
  EXPECT_NE(id, 0);
}

// A parked car shows its side, then its rear, too: the center of what is seen wanders.
TEST(ObstacleTracker, WhatIsSeenFromAnotherSideStands) {
  constexpr double kRadius_m = 0.3;
  const auto is_moving_after = [&](double travel_m) {
    ObstacleTracker tracker({});
    bool is_moving = false;
    for (int i = 0; i < 40; ++i) {
      const double t = 0.05 * i;
      const double x = std::clamp(0.4 * (t - 0.5), 0.0, travel_m);
      tracker.update({{{x, 2.0}, kRadius_m, 20, false}}, t);
      is_moving = is_moving || !tracker.moving_at(t).empty();
    }
    return is_moving;
  };
  EXPECT_FALSE(is_moving_after(0.25));
  EXPECT_TRUE(is_moving_after(0.5));
}

TEST(ObstacleTracker, TwoThatPassEachOtherKeepTheirIds) {
  ObstacleTracker tracker({});
  std::vector<int> ids;
  for (int i = 0; i <= 50; ++i) {
    const double t = 0.1 * i;
    tracker.update({seen(-2.5 + t, 0.3), seen(2.5 - t, -0.3)}, t);
    const Tracks& moving = tracker.moving_at(t);
    if (i == 10) {
      for (const Track& track : moving) ids.push_back(track.id);
    }
    if (i < 10) continue;
    ASSERT_EQ(moving.size(), 2U);
    EXPECT_EQ(moving[0].id, ids[0]);
    EXPECT_GT(moving[0].velocity.x, 0.5);
    EXPECT_EQ(moving[1].id, ids[1]);
    EXPECT_LT(moving[1].velocity.x, -0.5);
  }
}

TEST(ObstacleTracker, WhatIsSeenOnceIsNothingAndWhatIsGoneIsPredictedForAWhile) {
  const TrackerParams params;
  ObstacleTracker tracker(params);
  tracker.update({seen(0.0, 0.0)}, 0.0);
  tracker.update({}, 0.1);
  EXPECT_EQ(tracker.size(), 0U);
  double t = 0.0;
  for (; t < 2.0; t += 0.1) tracker.update({seen(t, 0.0)}, 5.0 + t);
  const double last_s = 5.0 + t - 0.1;
  tracker.update({}, last_s + 0.5);
  const Tracks tracks = tracker.moving_at(last_s + 0.5);
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_NEAR(tracks[0].position.x, t - 0.1 + 0.5, 0.1);
  EXPECT_GT(tracks[0].position_sigma(1.0), tracks[0].position_sigma(0.0));
  tracker.update({}, last_s + 0.01 + params.forget_after);
  EXPECT_EQ(tracker.size(), 0U);
}

TEST(ObstacleTracker, WhatLeavesTheFieldOfViewIsPredictedForLonger) {
  const TrackerParams params;
  ObstacleTracker tracker(params);
  // A lidar that sees what is before it, 90 degrees to each side.
  ScanPoints scan = scan_of({}, {0.0, 0.0}, kNaN, 720);
  scan.first_angle = -0.5 * kPi;
  scan.ends.resize(361);
  scan.is_full_turn = false;
  double t = 0.0;
  for (; t < 1.55; t += 0.1) tracker.update({seen(1.5 - t, 0.8)}, t, &scan);
  const double last_s = t - 0.1;
  for (; t < last_s + params.forget_hidden_after - 0.05; t += 0.1) {
    tracker.update({}, t, &scan);
    const Tracks& moving = tracker.moving_at(t);
    ASSERT_EQ(moving.size(), 1U) << t - last_s;
    EXPECT_NEAR(moving[0].unseen_s, t - last_s, 1e-9);
  }
  tracker.update({}, last_s + params.forget_hidden_after + 0.1, &scan);
  EXPECT_EQ(tracker.size(), 0U);
}

TEST(ScanPoints, SeeWhatBeamsReachInEitherOrderOfAngles) {
  ScanPoints scan = scan_of({{{2.0, 0.0}, 0.3}}, {0.0, 0.0});
  EXPECT_TRUE(scan.sees({2.0, 0.0}));
  EXPECT_TRUE(scan.sees({-3.0, -1.0}));
  EXPECT_FALSE(scan.sees({3.0, 0.0})) << "hidden by the disc";
  scan.ends.resize(361);  // the left half alone
  scan.is_full_turn = false;
  EXPECT_TRUE(scan.sees({0.0, 3.0}));
  EXPECT_FALSE(scan.sees({0.0, -3.0}));
  scan.is_clockwise = true;  // the right half alone
  EXPECT_FALSE(scan.sees({0.0, 3.0}));
  EXPECT_TRUE(scan.sees({0.0, -3.0}));
}

TEST(ObstacleTracker, ATimeThatGoesBackForgetsAndOneThatIsNotFiniteIsRefused) {
  ObstacleTracker tracker({});
  for (int i = 0; i < 20; ++i) tracker.update({seen(0.1 * i, 0.0)}, 10.0 + 0.1 * i);
  EXPECT_EQ(tracker.moving_at(12.0).size(), 1U);
  EXPECT_THROW(tracker.update({}, kNaN), Error);
  EXPECT_THROW(tracker.update({seen(kNaN, 0.0)}, 13.0), Error);
  EXPECT_EQ(tracker.moving_at(12.0).size(), 1U);
  tracker.update({seen(5.0, 0.0)}, 1.0);
  EXPECT_EQ(tracker.size(), 1U);
  EXPECT_TRUE(tracker.moving_at(1.0).empty());
}

}  // namespace
}  // namespace trident::nav
