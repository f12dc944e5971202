// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/core/path_cusps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trident::nav {
namespace {

/// Straight along x, forwards and backwards by turns: each length negative for backwards.
Path shuttle(const std::vector<double>& lengths_m, double step_m = 0.01) {
  Path path{{0.0, 0.0, 0.001}};
  for (const double length_m : lengths_m) {
    const double from_m = path.back().x;
    const int steps = static_cast<int>(std::lround(std::fabs(length_m) / step_m));
    for (int i = 1; i <= steps; ++i) {
      path.push_back({from_m + length_m * i / steps, 0.0, 0.001});
    }
  }
  return path;
}

TEST(PathCusps, AreWhereTheGearChanges) {
  const Path path = shuttle({1.0, -0.04, 0.08});
  ASSERT_TRUE(has_own_headings(path));
  const auto cusps = cusps_of(path);
  ASSERT_EQ(cusps.size(), 2U);
  EXPECT_NEAR(path[cusps[0].index].x, 1.0, 1e-12);
  EXPECT_NEAR(path[cusps[1].index].x, 0.96, 1e-12);
}

TEST(PathCusps, LeaveShortPartsToBeDriven) {
  const auto cusps = cusps_of(shuttle({1.0, -0.04, 1.0, -1.0}));
  ASSERT_EQ(cusps.size(), 3U);
  EXPECT_NEAR(cusps[0].tolerance_m, 0.01, 1e-12);  // a quarter of the short part
  EXPECT_NEAR(cusps[1].tolerance_m, 0.01, 1e-12);
  EXPECT_NEAR(cusps[2].tolerance_m, 0.05, 1e-12);
  EXPECT_NEAR(cusps_of(shuttle({0.01, -0.01}))[0].tolerance_m, 0.005, 1e-12);
}

TEST(PathCusps, ArePassedWithinMillimetersOrWhereTheRobotStands) {
  const Cusp cusp{0, 0.02};
  EXPECT_TRUE(cusp.is_passed(0.004, 1.0));
  EXPECT_FALSE(cusp.is_passed(0.019, 0.03));
  EXPECT_TRUE(cusp.is_passed(0.019, 0.0195));
  EXPECT_FALSE(cusp.is_passed(0.021, 0.021));
}

TEST(PathCusps, AreTheLastOfSeveralPosesInOnePlace) {
  Path path = shuttle({0.1, -0.1});
  const Path plain = path;
  path.insert(path.begin() + 10, path[10]);
  const auto cusps = cusps_of(path);
  ASSERT_EQ(cusps.size(), 1U);
  EXPECT_EQ(cusps[0].index, 11U);
  EXPECT_EQ(cusps_of(plain)[0].index, 10U);
}

TEST(PathCusps, NeedHeadingsOfThePathsOwn) {
  Path path = shuttle({0.1, -0.1});
  for (Pose2& pose : path) pose.yaw = 0.0;
  EXPECT_FALSE(has_own_headings(path));
  EXPECT_TRUE(cusps_of(path).empty());
  for (Pose2& pose : path) pose.yaw = 1.5;  // across
  EXPECT_FALSE(has_own_headings(path));
  EXPECT_FALSE(has_own_headings({}));
  EXPECT_FALSE(has_own_headings({{1.0, 2.0, 3.0}}));
  EXPECT_TRUE(cusps_of({{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}}).empty());
}

}  // namespace
}  // namespace trident::nav
