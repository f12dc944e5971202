// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Which scans are used, and which motion of odometry is believed.
#include "motion/motion_filter.h"

#include <gtest/gtest.h>

#include <limits>

#include "motion/odometry_motion.h"

namespace trident::slam {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(MotionFilter, ADistanceARotationOrATimeIsEnough) {
  const MotionFilter filter({0.5, 0.2, 3.0});
  EXPECT_FALSE(filter.is_due(SE2::from_xy_yaw(0.3, 0.3, 0.1), 2.9));
  EXPECT_TRUE(filter.is_due(SE2::from_xy_yaw(0.4, -0.4, 0.0)));
  EXPECT_TRUE(filter.is_due(SE2::from_xy_yaw(0.0, 0.0, -0.21)));
  EXPECT_TRUE(filter.is_due(SE2::identity(), 3.0));
}

TEST(MotionFilter, WithoutAPeriodARobotThatStandsAddsNothingNew) {
  const MotionFilter filter({0.5, 0.2});
  EXPECT_FALSE(filter.is_due(SE2::identity(), 1e9));
}

TEST(MotionFilter, ZeroTakesEveryScan) {
  EXPECT_TRUE(MotionFilter({0.0, 1.0}).is_due(SE2::identity()));
}

TEST(MotionFilter, WhatIsNoNumberIsNotDue) {
  EXPECT_FALSE(MotionFilter({0.5, 0.2, 3.0}).is_due(kNan, kNan, kNan));
}

TEST(OdometryMotion, MeasuresTheMotionFromScanToScan) {
  OdometryMotion odometry(1.0, 0.5);
  const SE2 first = SE2::from_xy_yaw(5.0, 3.0, 0.4);
  EXPECT_EQ(odometry.next(first).T_before_now.p.norm(), 0.0);
  const SE2 moved = SE2::from_xy_yaw(0.3, 0.1, -0.2);
  const OdometryMotion::Step step = odometry.next(first * moved);
  EXPECT_EQ(step.problem, "");
  EXPECT_LT((moved.inverse() * step.T_before_now).log().norm(), 1e-12);
}

TEST(OdometryMotion, ThePoseOfBeforeIsStale) {
  OdometryMotion odometry;
  const SE2 here = SE2::from_xy_yaw(1.0, 2.0, 0.3);
  EXPECT_FALSE(odometry.next(here).is_stale);
  EXPECT_TRUE(odometry.next(here).is_stale);
  EXPECT_FALSE(odometry.next(here * SE2::from_xy_yaw(0.0, 0.0, 1e-6)).is_stale);
}

TEST(OdometryMotion, AJumpIsReportedAndTheNextMotionBeginsThere) {
  OdometryMotion odometry(1.0, 0.5);
  odometry.next(SE2::identity());
  const OdometryMotion::Step far = odometry.next(SE2::from_xy_yaw(2.0, 0.0, 0.0));
  EXPECT_EQ(far.problem, "odometry jumped by 2 m, 0 rad, believed up to 1 m, 0.5 rad");
  EXPECT_EQ(far.T_before_now.p.norm(), 0.0);
  EXPECT_NE(odometry.next(SE2::from_xy_yaw(2.0, 0.0, 0.6)).problem, "");
  const OdometryMotion::Step next = odometry.next(SE2::from_xy_yaw(2.1, 0.0, 0.6));
  EXPECT_EQ(next.problem, "");
  EXPECT_NEAR(next.T_before_now.p.norm(), 0.1, 1e-12);
}

TEST(OdometryMotion, WhatIsNotANumberIsReportedAndPassedOver) {
  OdometryMotion odometry;
  odometry.next(SE2::from_xy_yaw(1.0, 0.0, 0.0));
  const OdometryMotion::Step bad = odometry.next(SE2::from_xy_yaw(kNan, 0.0, 0.0));
  EXPECT_NE(bad.problem.find("is not finite"), std::string::npos) << bad.problem;
  EXPECT_EQ(bad.T_before_now.p.norm(), 0.0);
  EXPECT_NEAR(odometry.next(SE2::from_xy_yaw(1.5, 0.0, 0.0)).T_before_now.p.x(), 0.5, 1e-12);
}

TEST(OdometryMotion, AfterForgettingAnyPlaceIsTheFirst) {
  OdometryMotion odometry(1.0, 0.5);
  odometry.next(SE2::identity());
  odometry.forget();
  EXPECT_EQ(odometry.next(SE2::from_xy_yaw(50.0, 0.0, 3.0)).problem, "");
}

}  // namespace
}  // namespace trident::slam
