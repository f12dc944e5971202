// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Planar lidars: gazebo_ros' snapshots and our rolling scans.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lidar_rig.h"
#include "test_world.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

OutPort<LaserScanSample>& listen(TestWorld& world) {
  auto* port = world->ports().find_out<LaserScanSample>("r/scan");
  port->add_listener();
  return *port;
}

TEST(LaserScanner, SeesTheWallsWhereTheyAre) {
  TestWorld world(weightless());
  add_walls(world, 4.0);
  world.add(robot_with({}));
  auto& scan = listen(world);
  world->step(100);
  ASSERT_EQ(scan.count(), 1u);
  const LaserScanSample& value = scan.value;
  EXPECT_EQ(value.stamp, world->time());
  EXPECT_EQ(value.frame, "r/link");
  EXPECT_NEAR(value.angle_increment_rad, kPi / 180.0, 1e-8);
  EXPECT_EQ(value.time_increment_s, 0.0);
  ASSERT_EQ(value.ranges.size(), 360u);
  for (std::size_t i = 0; i < value.ranges.size(); ++i) {
    const double angle = value.angle_min_rad + static_cast<double>(i) * value.angle_increment_rad;
    EXPECT_NEAR(value.ranges[i], wall_range(4.0, angle), 1e-4) << i;
  }
}

TEST(LaserScanner, OneThatIsAllButLevelLosesNoBeams) {
  // Beams whose height about changes its sign, a few at a time.
  for (const double tilt : {1e-6, 1e-9, 1e-12, 1e-15, 1e-18, 1e-20}) {
    for (const double azimuth : {0.3, kPi / 4.0, 3.0 * kPi / 4.0}) {
      TestWorld world(weightless(0.002));
      add_walls(world, 4.0);
      LidarOptions options;
      options.file = "libtrident_lidar.so";
      options.rate_hz = 5.5;
      const Eigen::Vector3d axis(std::cos(azimuth), std::sin(azimuth), 0.0);
      options.T_link_sensor.R = Eigen::AngleAxisd(tilt, axis);
      options.T_link_sensor.p = {0, 0, 0.15};
      world.add(robot_with(options));
      auto& scan = listen(world);
      world->step(300);
      for (std::size_t i = 0; i < 360; ++i) {
        EXPECT_NEAR(scan.value.ranges[i], wall_range(4.0, static_cast<double>(i) * kPi / 180.0),
                    1e-3)
            << tilt << " rad about " << azimuth << ", beam " << i;
      }
    }
  }
}

TEST(LaserScanner, OutOfRangeIsInfinite) {
  TestWorld world(weightless());
  world.add(make_static("far", BoxShape{{1, 1, 1}}, at(20.5, 0, 0)));
  world.add(make_static("near", BoxShape{{1, 1, 1}}, at(0, 3.5, 0)));
  LidarOptions options;
  options.beams = 4;
  options.max_rad = 1.5 * kPi;
  world.add(robot_with(options));
  auto& scan = listen(world);
  world->step(100);
  EXPECT_EQ(scan.value.ranges[0], kInf);
  EXPECT_NEAR(scan.value.ranges[1], 3.0, 1e-4);
  EXPECT_EQ(scan.value.ranges[2], kInf);
}

TEST(LaserScanner, SitsWhereTheSensorIsOnTheLink) {
  TestWorld world(weightless());
  add_walls(world, 4.0);
  LidarOptions options;
  options.beams = 4;
  options.max_rad = 1.5 * kPi;
  options.T_link_sensor = SE3::from_xyz_rpy({0.5, 0, 0.3}, 0, 0, kPi / 2.0);
  world.add(robot_with(options));
  auto& scan = listen(world);
  world->step(100);
  const float expected[] = {4.0F, 4.5F, 4.0F, 3.5F};  // north, west, south, east
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(scan.value.ranges[i], expected[i], 1e-4) << i;
}

TEST(LaserScanner, ASensorThatSeesVisualsDoesNotSeeCollisions) {
  for (const bool sees_visuals : {false, true}) {
    TestWorld world(weightless());
    ModelSpec ghost = make_static("ghost", BoxShape{{1, 1, 1}}, at(3.5, 0, 0));
    VisualSpec visual;
    visual.name = "v";
    visual.shape = BoxShape{{3, 1, 1}};
    ghost.links[0].visuals.push_back(visual);
    world.add(ghost);
    LidarOptions options;
    options.beams = 1;
    options.type = sees_visuals ? "gpu_ray" : "ray";
    world.add(robot_with(options));
    auto& scan = listen(world);
    world->step(100);
    EXPECT_NEAR(scan.value.ranges[0], sees_visuals ? 2.0 : 3.0, 1e-4);
  }
}

TEST(LaserScanner, NoiseHasItsSpreadAndIsTheSameForEverySubscriber) {
  std::vector<float> first;
  for (const int late : {0, 500}) {
    TestWorld world(weightless());
    add_walls(world, 4.0);
    LidarOptions options;
    options.stddev_m = 0.05;
    world.add(robot_with(options));
    world->step(static_cast<std::uint64_t>(late));
    auto& scan = listen(world);
    world->step(static_cast<std::uint64_t>(1000 - late));
    if (late == 0) first = scan.value.ranges;
    EXPECT_EQ(scan.value.ranges, first) << "who came late sees the same scan";
    double squares = 0.0;
    for (std::size_t i = 0; i < 360; ++i) {
      const double angle = scan.value.angle_min_rad + static_cast<double>(i) * kPi / 180.0;
      squares += std::pow(scan.value.ranges[i] - wall_range(4.0, angle), 2);
    }
    EXPECT_NEAR(std::sqrt(squares / 360.0), 0.05, 4.0 * 0.05 / std::sqrt(720.0));
  }
}

TEST(LaserScanner, WithoutListenersNothingIsCast) {
  TestWorld world(weightless());
  add_walls(world, 4.0);
  world.add(robot_with({}));
  world->step(500);
  EXPECT_EQ(world->ports().find_out<LaserScanSample>("r/scan")->count(), 0u);
}

TEST(RollingLidar, AtRestSeesWhatASnapshotSees) {
  TestWorld world(weightless());
  add_walls(world, 4.0);
  LidarOptions options;
  options.file = "libtrident_lidar.so";
  world.add(robot_with(options));
  auto& scan = listen(world);
  world->step(100);
  ASSERT_EQ(scan.count(), 1u) << "the first scan ends before the second begins";
  EXPECT_EQ(scan.value.stamp, SimTime{0});
  EXPECT_NEAR(scan.value.scan_time_s, 0.1, 1e-12);
  EXPECT_NEAR(scan.value.time_increment_s, 0.1 / 360.0, 1e-12);
  for (std::size_t i = 0; i < 360; ++i) {
    const double angle = static_cast<double>(i) * kPi / 180.0;
    EXPECT_NEAR(scan.value.ranges[i], wall_range(4.0, angle), 1e-4) << i;
  }
  world->step(200);
  EXPECT_EQ(scan.count(), 3u);
  EXPECT_EQ(scan.value.stamp, SimTime{200'000'000});
}

TEST(RollingLidar, OfASpinningRobotIsUndoneByTheTimesOfItsBeams) {
  constexpr double kSpin = 3.0;  // [rad/s]
  TestWorld world(weightless(), with_timing(LoopTiming::kDirect));
  add_walls(world, 4.0);
  LidarOptions options;
  options.file = "libtrident_lidar.so";
  Model& robot = world.add(robot_with(options));
  world->set_model_twist(robot, {0, 0, 0}, {0, 0, kSpin});
  auto& scan = listen(world);
  world->step(300);
  const LaserScanSample& value = scan.value;
  double worst = 0.0, worst_as_snapshot = 0.0;
  for (std::size_t i = 0; i < 360; ++i) {
    const double angle = static_cast<double>(i) * kPi / 180.0;
    const double since_zero =
        value.stamp.seconds() + static_cast<double>(i) * value.time_increment_s;
    const double error = value.ranges[i] - wall_range(4.0, angle + kSpin * since_zero);
    const double as_snapshot =
        value.ranges[i] - wall_range(4.0, angle + kSpin * value.stamp.seconds());
    worst = std::max(worst, std::abs(error));
    worst_as_snapshot = std::max(worst_as_snapshot, std::abs(as_snapshot));
  }
  EXPECT_LT(worst, 2e-3);
  EXPECT_GT(worst_as_snapshot, 0.3) << "the motion does distort the scan";
}

TEST(RollingLidar, AScanPerPeriodWhateverTheStep) {
  for (const double dt_s : {0.001, 0.004, 0.03}) {
    TestWorld world(weightless(dt_s));
    add_walls(world, 4.0);
    LidarOptions options;
    options.file = "libtrident_lidar.so";
    options.rate_hz = 5.5;
    world.add(robot_with(options));
    auto& scan = listen(world);
    world->step(static_cast<std::uint64_t>(std::ceil(4.0 / dt_s)));
    EXPECT_EQ(scan.count(), 22u) << dt_s;
    for (const float range : scan.value.ranges) EXPECT_LT(range, 6.0F);
  }
}

TEST(RollingLidar, NeedsARate) {
  TestWorld world(weightless());
  LidarOptions options;
  options.file = "libtrident_lidar.so";
  options.rate_hz = 0.0;
  EXPECT_TRUE(contains(error_of([&] { world.add(robot_with(options)); }), "<update_rate> > 0"));
}

}  // namespace
}  // namespace trident::sim
