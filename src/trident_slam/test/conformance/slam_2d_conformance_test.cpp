// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What Slam2d promises, asked of every algorithm of the registry.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "conformance/scan_world.h"
#include "trident_slam/slam_2d_capabilities.h"
#include "trident_slam/slam_2d_factory.h"

namespace trident::slam {
namespace {

using testing_world::ScanWorld;

const ScanWorld& world() {
  static const ScanWorld instance(11);
  return instance;
}

Registry<Slam2dFactory> registry() { return builtin_slam_2d(); }

/// How near each comes to the truth in that room, with its defaults: largest error of a final pose
/// [m], and share of the occupied cells that lie within 15 cm of a surface. Odometry alone is the
/// measure of what the others must beat.
struct Expected {
  double largest_error;
  double map_share;
};
const std::map<std::string, Expected>& expected() {
  static const std::map<std::string, Expected> table = {
      {"ekf_slam_2d", {0.3, 0.8}},
      {"graph_slam_2d", {0.08, 0.97}},
      {"hector_slam_2d", {0.1, 0.97}},
      {"odometry", {6.0, 0.0}},
  };
  return table;
}

/// A drive with something wrong in it need not be as long as the others.
constexpr std::size_t kScansOfALap = 160;
constexpr std::size_t kScansAfterProblem = 130;

bool is_same(const SE2& a, const SE2& b) { return a.p == b.p && a.angle == b.angle; }

/// One algorithm after the whole drive, and what it said to each scan.
struct Driven {
  std::unique_ptr<Slam2d> slam;
  std::vector<ScanPose2d> poses;
};

Driven drive(const std::string& method) {
  Driven driven{registry().get(method)(Slam2dSetup()), {}};
  for (const auto& step : world().steps()) {
    driven.poses.push_back(driven.slam->add_scan(step.scan, step.T_odom_base));
  }
  driven.slam->finish();
  return driven;
}

class Slam2dConformance : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Slam2d> make() const { return registry().get(GetParam())(Slam2dSetup()); }
  /// Each algorithm's first whole drive: several tests look at it, none changes it.
  static const Driven& driven() {
    static std::map<std::string, Driven> known;
    auto it = known.find(GetParam());
    if (it == known.end()) it = known.emplace(GetParam(), drive(GetParam())).first;
    return it->second;
  }
  static Expected expectation() {
    const auto it = expected().find(GetParam());
    return it == expected().end() ? Expected{0.15, 0.9} : it->second;
  }
  /// Largest distance of the trajectory from the truth [m], scans in `left_out` apart.
  static double largest_error(const Slam2d& slam) {
    const auto trajectory = slam.trajectory();
    double largest = 0.0;
    for (std::size_t k = 0; k < trajectory.size(); ++k) {
      largest = std::max(largest,
                         (trajectory[k].T_map_base.p - world().steps()[k].T_start_base.p).norm());
    }
    return largest;
  }
};

TEST_P(Slam2dConformance, EveryScanHasAPoseNearTheTruth) {
  for (const ScanPose2d& pose : driven().poses) {
    ASSERT_TRUE(pose.T_map_base.p.allFinite() && std::isfinite(pose.T_map_base.angle));
    ASSERT_TRUE(pose.covariance.allFinite());
    EXPECT_TRUE(pose.is_used);
    EXPECT_EQ(pose.problem, "");
  }
  const auto trajectory = driven().slam->trajectory();
  ASSERT_EQ(trajectory.size(), world().steps().size());
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    ASSERT_EQ(trajectory[k].stamp_ns, world().steps()[k].scan.stamp_ns);
  }
  EXPECT_LT((trajectory.front().T_map_base.p).norm(), 0.05);
  EXPECT_LT(largest_error(*driven().slam), expectation().largest_error);
}

TEST_P(Slam2dConformance, TheMapShowsTheWalls) {
  const OccupancyGrid map = driven().slam->map();
  ASSERT_EQ(map.cells.size(), static_cast<std::size_t>(map.width) * map.height);
  int occupied = 0;
  int near = 0;
  int free = 0;
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      const std::int8_t cell = map.cells[map.index(column, row)];
      free += cell == OccupancyGrid::kFree ? 1 : 0;
      if (cell != OccupancyGrid::kOccupied) continue;
      ++occupied;
      near += world().distance_to_surface(map.center_in_map(column, row)) < 0.15 ? 1 : 0;
    }
  }
  EXPECT_GT(occupied, 200);
  EXPECT_GT(near, expectation().map_share * occupied);
  EXPECT_GT(free * map.resolution * map.resolution, 50.0) << "m^2 of a room of 96";
}

TEST_P(Slam2dConformance, APoseDependsOnTheScansUpToItAlone) {
  // From here on other scans come; and a question in between is no scan.
  const auto slam = make();
  const std::size_t part = world().steps().size() / 4;
  for (std::size_t k = 0; k <= part; ++k) {
    const auto& step = world().steps()[k];
    const ScanPose2d pose = slam->add_scan(step.scan, step.T_odom_base);
    ASSERT_TRUE(is_same(pose.T_map_base, driven().poses[k].T_map_base)) << "scan " << k;
    if (k == part / 2) {
      ASSERT_EQ(slam->trajectory().size(), k + 1);
      ASSERT_FALSE(slam->map().cells.empty());
    }
  }
}

TEST_P(Slam2dConformance, TheSameScansGiveTheSameBits) {
  const Driven& a = driven();
  const Driven b = drive(GetParam());
  for (std::size_t k = 0; k < a.poses.size(); ++k) {
    ASSERT_TRUE(is_same(a.poses[k].T_map_base, b.poses[k].T_map_base)) << "scan " << k;
  }
  const auto path_a = a.slam->trajectory();
  const auto path_b = b.slam->trajectory();
  ASSERT_EQ(path_a.size(), path_b.size());
  for (std::size_t k = 0; k < path_a.size(); ++k) {
    ASSERT_TRUE(is_same(path_a[k].T_map_base, path_b[k].T_map_base));
  }
  EXPECT_EQ(a.slam->map().cells, b.slam->map().cells);
}

TEST_P(Slam2dConformance, BadScansAreReportedAndHarmNothing) {
  const auto slam = make();
  int reported = 0;
  for (std::size_t k = 0; k < kScansOfALap; ++k) {
    const auto& step = world().steps()[k];
    LaserScan scan = step.scan;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    const bool is_bad = k % 20 == 10;
    if (k % 80 == 10) scan.ranges.assign(scan.size(), nan);
    if (k % 80 == 30) scan.ranges.assign(scan.size(), infinite);
    if (k % 80 == 50) scan.ranges.assign(scan.size(), 0.0F);
    if (k % 80 == 70) scan.ranges.resize(scan.size() / 2);
    for (std::size_t beam = k % 7; beam < scan.size(); beam += 37) scan.ranges[beam] = nan;
    const ScanPose2d pose = slam->add_scan(scan, step.T_odom_base);
    ASSERT_TRUE(pose.T_map_base.p.allFinite());
    if (is_bad && !pose.problem.empty()) ++reported;
  }
  slam->finish();
  EXPECT_LT(largest_error(*slam), 1.5 * expectation().largest_error);
  if (GetParam() != "odometry") EXPECT_GE(reported, static_cast<int>(kScansOfALap) / 20 - 1);
}

TEST_P(Slam2dConformance, OdometryThatIsNotANumberIsReportedAndHarmsNothing) {
  if (GetParam() == "odometry") GTEST_SKIP() << "it has nothing but odometry";
  const auto slam = make();
  for (std::size_t k = 0; k < kScansAfterProblem; ++k) {
    const auto& step = world().steps()[k];
    SE2 T_odom_base = step.T_odom_base;
    if (k == 60) T_odom_base.p.x() = std::numeric_limits<double>::quiet_NaN();
    const ScanPose2d pose = slam->add_scan(step.scan, T_odom_base);
    ASSERT_TRUE(pose.T_map_base.p.allFinite());
    EXPECT_EQ(pose.problem.empty(), k != 60) << pose.problem;
  }
  slam->finish();
  EXPECT_LT(largest_error(*slam), 1.5 * expectation().largest_error);
}

TEST_P(Slam2dConformance, AJumpOfOdometryIsReportedAndHarmsNothing) {
  if (GetParam() == "odometry") GTEST_SKIP() << "it has nothing but odometry";
  const auto slam = make();
  const SE2 jump = SE2::from_xy_yaw(30.0, -20.0, 1.0);
  for (std::size_t k = 0; k < kScansAfterProblem; ++k) {
    const auto& step = world().steps()[k];
    const SE2 T_odom_base = k < 90 ? step.T_odom_base : jump * step.T_odom_base;
    const ScanPose2d pose = slam->add_scan(step.scan, T_odom_base);
    EXPECT_EQ(pose.problem.empty(), k != 90) << pose.problem;
  }
  slam->finish();
  EXPECT_LT(largest_error(*slam), 1.5 * expectation().largest_error);
}

TEST_P(Slam2dConformance, OdometryThatStandsIsReportedOnceAndTheScansTakeItsPlace) {
  for (const bool uses_odometry : {true, false}) {
    const auto slam = make();
    auto* able = dynamic_cast<Slam2dOdometryUse*>(slam.get());
    if (able == nullptr) GTEST_SKIP() << "it needs odometry";
    able->set_uses_odometry(uses_odometry);
    int reported = 0;
    for (std::size_t k = 0; k < kScansOfALap; ++k) {
      const ScanPose2d pose = slam->add_scan(world().steps()[k].scan, SE2::from_xy_yaw(4, 5, 1));
      if (!pose.problem.empty()) ++reported;
    }
    slam->finish();
    EXPECT_EQ(reported, uses_odometry ? 1 : 0);
    EXPECT_LT(largest_error(*slam), 1.5 * expectation().largest_error);
  }
}

TEST_P(Slam2dConformance, AnUnknownKeyOfItsFileIsAnError) {
  EXPECT_THROW(registry().get(GetParam())(Slam2dSetup("no_such_file.yaml")), Error);
}

INSTANTIATE_TEST_SUITE_P(Methods, Slam2dConformance, testing::ValuesIn(registry().names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace trident::slam
