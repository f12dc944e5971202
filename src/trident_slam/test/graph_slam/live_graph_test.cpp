// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What a node asks of graph_slam_2d while scans arrive.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <future>
#include <vector>

#include "graph_slam/polygon_world.h"
#include "trident_slam/graph_slam_2d.h"

namespace trident::slam {
namespace {

double distance(const SE2& T, const SE2& T_true) { return (T.p - T_true.p).norm(); }

TEST(LiveGraph, MapsSessionsAndOptimizationsRunAlongsideTheScans) {
  const std::string session = ::testing::TempDir() + "/live_graph.posegraph";
  const PolygonWorld world = ring_world();
  const std::vector<SE2> path = ring_path(1.0);
  const std::vector<SE2> odometry = drifting_odometry(path, 1.02, 0.99);
  GraphSlamOptions options;
  options.is_asynchronous = true;
  options.keep_scans = false;
  GraphSlam2d slam(options);
  std::vector<std::future<OccupancyGrid>> maps;
  std::vector<std::future<void>> saves;
  int realigned = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    slam.add_scan(world.scan(path[i], i), odometry[i]);
    // On a machine with other work the thread may not get so far while scans come.
    if (i == 150) slam.finish();
    if (i > 40 && !slam.is_busy()) {
      slam.realign();
      ++realigned;
    }
    if (i % 100 != 99) continue;
    maps.push_back(std::async(std::launch::async, slam.map_snapshot()));
    saves.push_back(std::async(std::launch::async, slam.session_snapshot(),
                               session + std::to_string(saves.size())));
  }
  slam.finish();
  EXPECT_GT(realigned, 0);
  // Which loops were closed while the robot drove is a matter of the threads' speed.
  const SE2 end = slam.trajectory().back().T_map_base;
  EXPECT_LT(distance(end, path.front().inverse() * path.back()), 0.05);
  EXPECT_EQ(slam.map_snapshot()().cells, slam.map().cells);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    EXPECT_FALSE(maps[i].get().cells.empty());
    saves[i].get();
    GraphSlam2d again(options);
    again.load_session(session + std::to_string(i));
    EXPECT_EQ(again.trajectory().size(), 100 * (i + 1));  // every scan until that call
    std::remove((session + std::to_string(i)).c_str());
  }
}

TEST(LiveGraph, ScansWithoutRangesKeepTheirPosesRelativeToTheirKeyframes) {
  const PolygonWorld world = ring_world();
  const std::vector<SE2> path = ring_path(0.3);
  const std::vector<SE2> odometry = drifting_odometry(path, 1.02, 0.99);
  GraphSlamOptions options;
  options.keep_scans = false;
  GraphSlam2d slam(options);
  for (std::size_t i = 0; i < path.size(); ++i) {
    slam.add_scan(world.scan(path[i], i), odometry[i]);
  }
  slam.finish();
  const std::vector<StampedPose2d> poses = slam.trajectory();
  ASSERT_EQ(poses.size(), path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_LT(distance(poses[i].T_map_base, path.front().inverse() * path[i]), 0.05) << i;
  }
}

/// A corridor is mapped almost to its corner by a robot that sees 7 m far; then the robot localises
/// itself around the corner and beyond it.
class BeyondTheMap : public ::testing::Test {
 protected:
  static constexpr std::size_t kMapped = 140;
  static constexpr std::size_t kScans = 240;

  double largest_error(int scan_buffer_size, bool clears_buffer = false) {
    GraphSlamOptions options;
    options.scan_buffer_size = scan_buffer_size;
    options.max_laser_range = 7.0;
    GraphSlam2d slam(options);
    std::size_t i = 0;
    for (; i < kMapped; ++i) slam.add_scan(world_.scan(path_[i], i), odometry_[i]);
    slam.set_mode(SlamMode::kLocalization);
    const OccupancyGrid map = slam.map();
    const int nodes = slam.nodes();
    double largest = 0.0;
    for (; i < kScans; ++i) {
      if (clears_buffer) slam.clear_localization_buffer();
      const ScanPose2d pose = slam.add_scan(world_.scan(path_[i], i), odometry_[i]);
      largest = std::max(largest, distance(pose.T_map_base, path_.front().inverse() * path_[i]));
    }
    EXPECT_EQ(slam.map().cells, map.cells);
    EXPECT_EQ(slam.nodes(), nodes);
    EXPECT_EQ(slam.trajectory().size(), kMapped);
    return largest;
  }

  PolygonWorld world_ = ring_world();
  std::vector<SE2> path_ = ring_path(1.0);
  std::vector<SE2> odometry_ = drifting_odometry(path_, 1.05, 0.97);
};

TEST_F(BeyondTheMap, RecentScansCarryOnAndTheMapIsNotChanged) {
  EXPECT_LT(largest_error(10), 0.1);
  const double without = largest_error(0);
  EXPECT_GT(without, 0.5);
  EXPECT_EQ(largest_error(10, true), without);  // what was forgotten does not help
}

}  // namespace
}  // namespace trident::slam
