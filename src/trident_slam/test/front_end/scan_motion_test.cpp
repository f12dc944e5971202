// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "motion/scan_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "matchers/correlative_match.h"
#include "motion/odometry_watch.h"

namespace trident::slam {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;

TEST(ScanMotion, AtFirstTheRobotStands) {
  const ExpectedMotion motion = ScanMotion().expected(0);
  EXPECT_EQ(motion.T_before_now.p.norm(), 0.0);
  EXPECT_GT(motion.spread.s_p, 0.03);
}

TEST(ScanMotion, AVelocityContinuesOverScansThatAreMissing) {
  ScanMotion motion;
  std::int64_t stamp_ms = 0;
  for (int k = 0; k < 60; ++k) {  // 1 m/s, every seventh scan is missing
    const int step_ms = k % 7 == 6 ? 200 : 100;
    stamp_ms += step_ms;
    motion.add(stamp_ms * kMillisecond, SE2::from_xy_yaw(1e-3 * step_ms, 0.0, 0.0), true);
  }
  EXPECT_NEAR(motion.expected((stamp_ms + 100) * kMillisecond).T_before_now.p.x(), 0.1, 0.01);
  EXPECT_NEAR(motion.expected((stamp_ms + 200) * kMillisecond).T_before_now.p.x(), 0.2, 0.01);
}

TEST(ScanMotion, StampsThatLieAreNotFollowed) {
  ScanMotion motion;
  std::int64_t stamp_ms = 0;
  const int steps_ms[] = {1, 340, 1, -600, 900, 1, 3400, -2900, 100, 1};
  for (int k = 0; k < 100; ++k) {  // the robot drives on all the same
    stamp_ms += steps_ms[k % 10];
    motion.add(stamp_ms * kMillisecond, SE2::from_xy_yaw(0.05, 0.0, 0.0), true);
  }
  for (const int step_ms : steps_ms) {
    const ExpectedMotion expected = motion.expected((stamp_ms + step_ms) * kMillisecond);
    EXPECT_NEAR(expected.T_before_now.p.x(), 0.05, 0.01) << step_ms;
  }
}

TEST(ScanMotion, NoPairOfStampsSendsTheRobotOff) {
  ScanMotion motion;
  for (const std::int64_t stamp : {std::int64_t{0}, kMillisecond, INT64_MAX, INT64_MIN}) {
    motion.add(stamp, SE2::from_xy_yaw(0.3, 0.0, 0.3), true);
    for (const std::int64_t next : {INT64_MIN, std::int64_t{1}, INT64_MAX}) {
      const ExpectedMotion expected = motion.expected(next);
      EXPECT_LT(expected.T_before_now.p.norm(), 3.0);
      EXPECT_TRUE(std::isfinite(expected.spread.s_p) && expected.spread.s_p <= 0.3);
    }
  }
}

TEST(OdometryWatch, ALaserThatSitsElsewhereThanConfiguredIsNoReasonWhileTheRobotTurns) {
  OdometryWatch watch;
  for (int k = 0; k < 200; ++k) {  // on the spot; the laser is 0.3 m off
    const SE2 turn = SE2::from_xy_yaw(0.0, 0.0, 0.05);
    const SE2 T_base_laser = SE2::from_xy_yaw(0.3, 0.0, 0.0);
    watch.add(turn, T_base_laser * turn * T_base_laser.inverse(), true);
    ASSERT_FALSE(watch.is_silent()) << k;
  }
}

TEST(OdometryWatch, ADriverThatLagsForAFewScansIsWaitedFor) {
  OdometryWatch watch;
  const SE2 step = SE2::from_xy_yaw(0.2, 0.0, 0.0);
  for (int k = 0; k < 20; ++k) watch.add(step, step, true);
  for (int round = 0; round < 20; ++round) {  // four scans of the same pose, then all in one step
    for (int k = 0; k < 4; ++k) watch.add({}, step, true);
    ASSERT_FALSE(watch.is_silent());
    watch.add(SE2::from_xy_yaw(1.0, 0.0, 0.0), step, true);
  }
}

// A window of 200 km in steps of 5 cm: nothing is found, but not after hours nor out of memory.
TEST(CorrelativeMatch, ASearchCostsAtMostWhatItsLimitSays) {
  MaxPyramid hits(0.05, 4);
  PointScan scan;
  for (int i = 0; i < 100; ++i) scan.points.push_back({{0.1F * static_cast<float>(i), 1.0F}, {}});
  hits.insert(SE2::identity(), scan);
  const SE2 far = SE2::from_xy_yaw(5e4, 5e4, 0.0);
  EXPECT_FALSE(match_by_branch_and_bound(hits, thinned_points(scan, 100), far, {1e5, 3.2}, 0.9));
}

}  // namespace
}  // namespace trident::slam
