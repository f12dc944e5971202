// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Odometry that says nothing, and none at all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "graph_slam/polygon_world.h"
#include "trident_slam/graph_slam_2d.h"

namespace trident::slam {
namespace {

/// Odometry that stands where it is.
const SE2 kStill = SE2::from_xy_yaw(3.0, -2.0, 0.7);

class NoOdometry : public testing::Test {
 protected:
  /// Where scan i is in the map, whose origin is the first pose of the path.
  SE2 truth(std::size_t i) const { return path_.front().inverse() * path_[i]; }
  double error(const SE2& T, std::size_t i) const { return (T.p - truth(i).p).norm(); }

  void drive(GraphSlam2d& slam, std::size_t begin, std::size_t end,
             const std::vector<SE2>& odometry) {
    for (std::size_t i = begin; i < end; ++i) {
      last_ = slam.add_scan(world_.scan(path_[i], i), odometry[i]);
      if (!last_.problem.empty()) {
        problems_.push_back("scan " + std::to_string(i) + ": " + last_.problem);
      }
    }
  }
  double largest_final_error(GraphSlam2d& slam) const {
    slam.finish();
    double largest = 0.0;
    const std::vector<StampedPose2d> poses = slam.trajectory();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      largest = std::max(largest, error(poses[i].T_map_base, i));
    }
    return largest;
  }

  PolygonWorld world_ = ring_world();
  std::vector<SE2> path_ = ring_path(1.25);
  std::vector<SE2> still_ = std::vector<SE2>(path_.size(), kStill);
  ScanPose2d last_;
  std::vector<std::string> problems_;
};

TEST_F(NoOdometry, OneThatStandsIsNoticedAndReplacedByTheScans) {
  GraphSlam2d slam;
  drive(slam, 0, path_.size(), still_);
  ASSERT_EQ(problems_.size(), 1U);
  EXPECT_NE(problems_[0].find("odometry has stood still for"), std::string::npos) << problems_[0];
  EXPECT_EQ(last_.motion_by, MotionBy::kScansAsOdometryStands);
  EXPECT_LT(largest_final_error(slam), 0.08);
}

TEST_F(NoOdometry, OneThatAUserDoesNotWantIsNotLookedAt) {
  GraphSlamOptions options;
  options.use_odometry = false;
  GraphSlam2d slam(options);
  std::vector<SE2> nonsense = still_;
  for (std::size_t i = 0; i < nonsense.size(); ++i) nonsense[i].p.x() += i % 3 == 0 ? 50.0 : 0.2;
  drive(slam, 0, path_.size(), nonsense);
  EXPECT_TRUE(problems_.empty()) << problems_[0];
  EXPECT_EQ(last_.motion_by, MotionBy::kScansAsAsked);
  EXPECT_LT(largest_final_error(slam), 0.08);
}

TEST_F(NoOdometry, StampsThatLieSendTheRobotNowhere) {
  GraphSlamOptions options;
  options.use_odometry = false;
  GraphSlam2d slam(options);
  std::int64_t stamp_ns = 5'000'000'000;
  for (std::size_t i = 0; i < 400; ++i) {
    LaserScan scan = world_.scan(path_[i], i);
    // A millisecond apart, back, and after a pause, as a log of what was delivered when.
    const std::int64_t steps_ms[] = {1, 340, 1, -600, 900, 1, 3400, -2900, 100, 1};
    stamp_ns += steps_ms[i % 10] * 1'000'000;
    scan.stamp_ns = stamp_ns;
    ASSERT_LT(error(slam.add_scan(scan, kStill).T_map_base, i), 0.1) << "scan " << i;
  }
}

TEST_F(NoOdometry, ARobotThatReallyStandsStaysWhereItIs) {
  for (const bool uses_odometry : {true, false}) {
    GraphSlamOptions options;
    options.use_odometry = uses_odometry;
    GraphSlam2d slam(options);
    const std::vector<SE2> odometry = drifting_odometry(path_, 1.0, 1.0);
    drive(slam, 0, 40, odometry);
    for (std::size_t i = 0; i < 300; ++i) {
      const ScanPose2d pose = slam.add_scan(world_.scan(path_[39], 1000 + i), odometry[39]);
      ASSERT_LT(error(pose.T_map_base, 39), 0.03) << i;
      ASSERT_EQ(pose.problem, "");
    }
  }
}

TEST_F(NoOdometry, WheelsThatStopReportingAreLeftAndBelievedWhenTheyReportAgain) {
  GraphSlam2d slam;
  std::vector<SE2> odometry = drifting_odometry(path_, 1.03, 0.98);
  const std::size_t from = 200, to = 500;
  const SE2 T_stood_again = odometry[from] * odometry[to].inverse();
  for (std::size_t i = to; i < odometry.size(); ++i) odometry[i] = T_stood_again * odometry[i];
  for (std::size_t i = from; i < to; ++i) odometry[i] = odometry[from];
  drive(slam, 0, to, odometry);
  EXPECT_EQ(problems_.size(), 1U);
  EXPECT_EQ(last_.motion_by, MotionBy::kScansAsOdometryStands);
  drive(slam, to, path_.size(), odometry);
  ASSERT_EQ(problems_.size(), 2U);
  EXPECT_NE(problems_[1].find("odometry moves again: it is believed again"), std::string::npos);
  EXPECT_EQ(last_.motion_by, MotionBy::kOdometry);
  EXPECT_LT(largest_final_error(slam), 0.08);
}

TEST_F(NoOdometry, AHeadingThatStandsWhileTheWheelsReportTheDistanceIsNoticed) {
  GraphSlam2d slam;
  std::vector<SE2> odometry = drifting_odometry(path_, 1.0, 1.0);
  for (SE2& T : odometry) T.angle = 0.0;
  drive(slam, 0, path_.size(), odometry);
  EXPECT_GE(problems_.size(), 1U);
  EXPECT_LT(largest_final_error(slam), 0.08);
}

/// Two bare walls: nothing shows the motion along them.
TEST(NoOdometryCorridor, LeavesADirectionOpenAndSaysSo) {
  PolygonWorld world;
  world.add_polygon({{-60.0, -1.0}, {60.0, -1.0}, {60.0, 1.0}, {-60.0, 1.0}});
  GraphSlamOptions options;
  options.use_odometry = false;
  GraphSlam2d slam(options);
  double early = 0.0;
  for (std::size_t i = 0; i < 200; ++i) {
    const SE2 T = SE2::from_xy_yaw(0.02 * static_cast<double>(i), 0.0, 0.0);
    const ScanPose2d pose = slam.add_scan(world.scan(T, i), kStill);
    if (i == 0) continue;
    EXPECT_TRUE(pose.is_open) << i;
    const double along = std::sqrt(pose.covariance(0, 0));
    const double across = std::sqrt(pose.covariance(1, 1));
    EXPECT_LT(across, 0.03) << i;
    if (i == 10) early = along;
    if (i == 199) {
      EXPECT_GT(along, 3.0 * early);  // every step adds its own
      EXPECT_GT(along, 10.0 * across);
    }
  }
}

TEST_F(NoOdometry, ARoomLeavesNothingOpen) {
  PolygonWorld room;
  room.add_box(0.0, 0.0, 7.0, 5.0);
  room.add_box(3.0, 2.0, 3.5, 2.4);
  GraphSlamOptions options;
  options.use_odometry = false;
  GraphSlam2d slam(options);
  for (std::size_t i = 0; i < 100; ++i) {
    const SE2 T =
        SE2::from_xy_yaw(1.0 + 0.01 * static_cast<double>(i), 1.0, 0.02 * static_cast<double>(i));
    const ScanPose2d pose = slam.add_scan(room.scan(T, i), kStill);
    EXPECT_FALSE(pose.is_open);
    if (i > 0) EXPECT_LT(std::sqrt(pose.covariance.topLeftCorner<2, 2>().trace()), 0.03) << i;
  }
}

}  // namespace
}  // namespace trident::slam
