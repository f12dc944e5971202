// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Poses from outside that no map can continue from, and scans with wrong stamps.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <limits>

#include "conformance/scan_world.h"
#include "grids/growing_grid.h"
#include "trident_base/error.h"
#include "trident_slam/graph_slam_2d.h"
#include "trident_slam/hector_slam_2d.h"

namespace trident::slam {
namespace {

using testing_world::ScanWorld;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kScans = 20;

template <class Slam>
void drive(Slam& slam, std::size_t first, std::size_t last) {
  static const ScanWorld world(2 * kScans);
  for (std::size_t i = first; i < last; ++i) {
    slam.add_scan(world.steps()[i].scan, world.steps()[i].T_odom_base);
  }
}

std::vector<SE2> bad_poses() {
  std::vector<SE2> poses;
  for (const double bad : {kNan, kInf, -kInf, 1e308, 1e9, 5e4}) {
    SE2 pose;
    pose.p.x() = bad;
    poses.push_back(pose);
  }
  for (const double bad : {kNan, kInf}) {
    SE2 pose;
    pose.angle = bad;
    poses.push_back(pose);
  }
  return poses;
}

TEST(StartPose, ASessionIsNotLoadedAtAPlaceThatIsNone) {
  GraphSlam2d slam{GraphSlamOptions()};
  drive(slam, 0, kScans);
  const std::string file =
      testing::TempDir() + "/start_pose_" + std::to_string(getpid()) + ".posegraph";
  slam.save_session(file);
  const int keyframes = slam.nodes();
  const OccupancyGrid before = slam.map();
  for (const SE2& pose : bad_poses()) {
    EXPECT_THROW(slam.load_session(file, pose), Error) << pose.p.x() << " " << pose.angle;
    EXPECT_THROW(slam.set_pose(pose), Error) << pose.p.x() << " " << pose.angle;
    EXPECT_THROW(slam.append_session(file, pose), Error) << pose.p.x() << " " << pose.angle;
  }
  EXPECT_EQ(slam.nodes(), keyframes);
  EXPECT_EQ(slam.map().cells, before.cells) << "the map that was not saved is still there";
  drive(slam, kScans, 2 * kScans);
  EXPECT_GT(slam.nodes(), keyframes) << "and it grows on";
  slam.load_session(file, SE2::from_xy_yaw(1.0, -2.0, 0.5));
  EXPECT_EQ(slam.nodes(), keyframes);
  std::remove(file.c_str());
}

TEST(StartPose, OfHector) {
  HectorSlam2d slam{HectorSlamParams()};
  drive(slam, 0, kScans);
  const OccupancyGrid before = slam.map();
  for (const SE2& pose : bad_poses()) {
    EXPECT_THROW(slam.set_pose(pose), Error) << pose.p.x() << " " << pose.angle;
  }
  EXPECT_EQ(slam.map().cells, before.cells);
  slam.set_pose(SE2::from_xy_yaw(3.0, 0.0, 0.0));
}

TEST(StartPose, AMapMayLieAnywhereThatASingleFloatResolves) {
  GraphSlam2d slam{GraphSlamOptions()};
  slam.set_pose(SE2::from_xy_yaw(9e4, -9e4, 0.0));
  drive(slam, 0, 3);
  EXPECT_GT(slam.map().width, 10);
}

// The velocity between two such scans is beyond all measure, and was taken for that of the sweep.
TEST(StartPose, ScansANanosecondApartLeaveTheMapAsLargeAsItWas) {
  GraphSlam2d slam{GraphSlamOptions()};
  static const ScanWorld world(kScans);
  for (std::size_t i = 0; i < kScans; ++i) {
    LaserScan scan = world.steps()[i].scan;
    scan.stamp_ns = static_cast<std::int64_t>(i);
    scan.time_increment = 0.1 / static_cast<double>(scan.size());
    slam.add_scan(scan, world.steps()[i].T_odom_base);
  }
  EXPECT_LT(slam.map().width, 2000);
}

TEST(GrowingGrid, IsNotGrownBeyondItsMemory) {
  GrowingGrid<std::int32_t> grid;
  grid.at(0, 0) = 7;
  EXPECT_THROW(grid.at(1 << 20, 1 << 20), Error);
  EXPECT_THROW(grid.at(std::numeric_limits<int>::min(), 0), Error);
  EXPECT_THROW(grid.reserve(-(1 << 29), 0, 1 << 29, 0), Error);
  EXPECT_EQ(grid.get(0, 0), 7);
  grid.at(1000, 1000) = 8;
  EXPECT_EQ(grid.get(1000, 1000), 8);
}

}  // namespace
}  // namespace trident::slam
