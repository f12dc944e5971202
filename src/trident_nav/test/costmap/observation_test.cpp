// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/observation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "trident_base/error.h"

namespace trident::nav {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

LaserScan scan_of(const std::vector<float>& ranges) {
  LaserScan scan;
  scan.stamp_ns = 1'500'000'000;
  scan.angle_increment = 0.5 * kHalfTurn;
  scan.range_min = 0.1;
  scan.range_max = 10.0;
  scan.ranges = ranges;
  return scan;
}

Eigen::Vector3d end_of(const Observation& observation, std::size_t i) {
  for (const BeamGroup& group : observation.groups) {
    if (i >= group.first && i < group.first + group.count) {
      return group.origin + observation.ends[i].p.cast<double>();
    }
  }
  return Eigen::Vector3d::Constant(NAN);
}

TEST(ObservationTest, AScansBeamsInTheCostmapsFrame) {
  const SE3 pose = SE3::from_xyz_rpy({1.0, 2.0, 0.3}, 0.0, 0.0, 0.5 * kHalfTurn);
  const Observation seen = observe_scan(scan_of({2.0F, 3.0F}), {&pose, 1}, false);
  EXPECT_EQ(seen.stamp_s, 1.5);
  ASSERT_EQ(seen.groups.size(), 1U);
  ASSERT_EQ(seen.ends.size(), 2U);
  EXPECT_TRUE(end_of(seen, 0).isApprox(Eigen::Vector3d(1.0, 4.0, 0.3), 1e-6));
  EXPECT_TRUE(end_of(seen, 1).isApprox(Eigen::Vector3d(-2.0, 2.0, 0.3), 1e-6));
}

TEST(ObservationTest, ATiltedLasersBeamsHaveHeights) {
  const SE3 pose = SE3::from_xyz_rpy({0.0, 0.0, 1.0}, 0.0, 0.1, 0.0);
  const Observation seen = observe_scan(scan_of({2.0F}), {&pose, 1}, false);
  EXPECT_NEAR(end_of(seen, 0).z(), 1.0 - 2.0 * std::sin(0.1), 1e-6);
}

TEST(ObservationTest, RangesThatSayNothingAreLeftOut) {
  const std::vector<float> ranges{0.05F, 10.0F, kInfinity, NAN, -kInfinity, 0.0F, 2.0F};
  const SE3 pose;
  EXPECT_EQ(observe_scan(scan_of(ranges), {&pose, 1}, false).ends.size(), 1U);
  const Observation seen = observe_scan(scan_of(ranges), {&pose, 1}, true);
  ASSERT_EQ(seen.ends.size(), 3U);
  EXPECT_FALSE(seen.ends[0].is_hit);
  EXPECT_FALSE(seen.ends[1].is_hit);
  EXPECT_NEAR(seen.ends[1].p.norm(), 10.0F, 1e-5F);
  EXPECT_TRUE(seen.ends[2].is_hit);
}

TEST(ObservationTest, EachBeamIsPutWhereTheLaserWas) {
  // While a robot drives 1 m and turns a quarter, a wall at x = 5 is seen where it is.
  std::vector<float> ranges;
  std::vector<SE3> poses;
  LaserScan scan = scan_of({});
  scan.angle_min = -0.4;
  scan.angle_increment = 0.8 / 100;
  const auto pose_at = [](double t) {
    return SE3::from_xyz_rpy({t, 0.2 * t, 0.1}, 0.0, 0.0, 0.5 * t);
  };
  for (int i = 0; i <= 100; ++i) {
    const double t = i / 100.0;
    const double heading = 0.5 * t + scan.angle_min + i * scan.angle_increment;
    scan.ranges.push_back(static_cast<float>((5.0 - t) / std::cos(heading)));
  }
  for (int k = 0; k <= 10; ++k) poses.push_back(pose_at(k / 10.0));
  const Observation seen = observe_scan(scan, poses, false);
  ASSERT_EQ(seen.groups.size(), 101U);
  for (std::size_t i = 0; i < seen.ends.size(); ++i) EXPECT_NEAR(end_of(seen, i).x(), 5.0, 1e-5);
  const SE3 still = pose_at(0.5);
  const Observation skewed = observe_scan(scan, {&still, 1}, false);
  EXPECT_GT(std::abs(end_of(skewed, 0).x() - 5.0), 0.3);
}

TEST(ObservationTest, ScansThatCannotBeAreRefused) {
  const SE3 pose;
  EXPECT_THROW(observe_scan(scan_of({}), {&pose, 1}, false), Error);
  EXPECT_THROW(observe_scan(scan_of({1.0F}), {}, false), Error);
  LaserScan scan = scan_of({1.0F});
  scan.range_max = 0.05;
  EXPECT_NE(scan_fault(scan).find("range_min 0.1 m to range_max 0.05 m"), std::string::npos);
  scan = scan_of({1.0F});
  scan.angle_increment = NAN;
  EXPECT_NE(scan_fault(scan).find("finite"), std::string::npos);
}

TEST(ObservationTest, PointsThatAreNotFiniteAreLeftOut) {
  const std::vector<Eigen::Vector3f> points{{1.0F, 0.0F, 0.5F}, {NAN, 0.0F, 0.0F}};
  const SE3 pose = SE3::from_xyz_rpy({0.0, 1.0, 2.0}, 0.0, 0.0, 0.5 * kHalfTurn);
  const Observation seen = observe_points(3.0, points, pose);
  ASSERT_EQ(seen.ends.size(), 1U);
  EXPECT_TRUE(end_of(seen, 0).isApprox(Eigen::Vector3d(0.0, 2.0, 2.5), 1e-6));
}

}  // namespace
}  // namespace trident::nav
