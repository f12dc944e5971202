// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "core/fake_gps.h"
#include "core/recent_variance.h"
#include "core/transform_follower.h"
#include "core/wheel_odometry.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"

namespace trident::mavros {
namespace {

SimTime at_s(double seconds) { return SimTime::from_seconds(seconds); }

/// Wheels 0.3 m apart, `forward` [m] ahead of the vehicle's origin.
WheelOdometryParams two_wheels(double forward = 0.0) {
  WheelOdometryParams params;
  params.wheel0 = WheelParams{forward, -0.15, 0.05};
  params.wheel1 = WheelParams{forward, 0.15, 0.05};
  return params;
}

TEST(WheelOdometry, AFasterRightWheelTurnsToTheLeft) {
  WheelOdometry odometry(two_wheels());
  EXPECT_FALSE(odometry.add_distances({5.0, 5.0}, at_s(1.0)));
  const double quarter = kPi / 2, radius = 1.0;  // of the origin's arc
  const auto motion = odometry.add_distances(
      {5.0 + quarter * (radius - 0.15), 5.0 + quarter * (radius + 0.15)}, at_s(2.0));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->T_odom_base.p.x(), 1.0, 1e-12);
  EXPECT_NEAR(motion->T_odom_base.p.y(), 1.0, 1e-12);
  EXPECT_NEAR(motion->T_odom_base.angle, quarter, 1e-12);
  EXPECT_NEAR(motion->twist.x(), quarter, 1e-12);
  EXPECT_NEAR(motion->twist.z(), quarter, 1e-12);
}

TEST(WheelOdometry, AnOriginBehindTheAxleSwingsToTheRight) {
  WheelOdometry odometry(two_wheels(0.5));
  odometry.add_distances({0.0, 0.0}, at_s(1.0));
  const auto motion = odometry.add_distances({-0.15, 0.15}, at_s(1.5));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->T_odom_base.angle, 1.0, 1e-12);
  // The axle's middle, 0.5 m ahead of the origin, stays where it is.
  EXPECT_NEAR((motion->T_odom_base * Eigen::Vector2d(0.5, 0.0) - Eigen::Vector2d(0.5, 0.0)).norm(),
              0.0, 1e-12);
  EXPECT_NEAR(motion->twist.y(), -0.5 * 2.0, 1e-12);
}

TEST(WheelOdometry, TurnsPerMinuteAreDistancesByTheRadius) {
  WheelOdometry odometry(two_wheels());
  odometry.add_turns({0.0, 0.0}, at_s(1.0));
  const auto motion = odometry.add_turns({120.0, 120.0}, at_s(2.0));  // 60 on average
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->T_odom_base.p.x(), 2.0 * kPi * 0.05, 1e-12);
}

TEST(WheelOdometry, ItsCovarianceIsThatOfDisturbedWheels) {
  // Central differences of the end by the travel of each wheel in each step.
  const auto end = [](std::size_t changed, double by) {
    WheelOdometry odometry(two_wheels(0.4));
    odometry.add_distances({0.0, 0.0}, at_s(0.0));
    std::optional<WheelMotion> motion;
    double d[2] = {0.0, 0.0};
    const double travel[4] = {0.2, 0.31, 0.25, 0.25};
    for (std::size_t i = 0; i < 4; ++i) {
      d[i % 2] += travel[i] + (i == changed ? by : 0.0);
      if (i % 2 == 1) motion = odometry.add_distances({d[0], d[1]}, at_s(i));
    }
    return *motion;
  };
  constexpr double kStep = 1e-5, kTravelSigma_m = 0.1;  // 0.1 m/s, first for 1 s, then for 2 s
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    const SE2 plus = end(i, kStep).T_odom_base, minus = end(i, -kStep).T_odom_base;
    const Eigen::Vector3d by(plus.p.x() - minus.p.x(), plus.p.y() - minus.p.y(),
                             plus.angle - minus.angle);
    const double sigma = kTravelSigma_m * (i < 2 ? 1.0 : 2.0) / (2.0 * kStep);
    expected += sigma * sigma * by * by.transpose();
  }
  EXPECT_NEAR((end(4, 0.0).pose_covariance - expected).norm(), 0.0, 1e-8);
}

TEST(WheelOdometry, ItBeginsAgainWhereTheVehiclesClockGoesBack) {
  WheelOdometry odometry(two_wheels());
  odometry.add_distances({0.0, 0.0}, at_s(10.0));
  EXPECT_FALSE(odometry.add_distances({1.0, 1.0}, at_s(10.0)));
  EXPECT_FALSE(odometry.add_distances({100.0, 100.0}, at_s(1.0)));
  EXPECT_FALSE(odometry.add_distances({101.0}, at_s(2.0)));
  const auto motion = odometry.add_distances({101.0, 101.0}, at_s(3.0));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->T_odom_base.p.x(), 1.0, 1e-12);
}

TEST(WheelOdometry, TheHeadingOfTheVehicleTurnsWhatWasDriven) {
  WheelOdometry odometry(two_wheels());
  odometry.add_distances({0.0, 0.0}, at_s(1.0));
  odometry.add_distances({1.0, 1.0}, at_s(2.0));
  odometry.set_yaw(kPi / 2);
  const auto motion = odometry.add_distances({2.0, 2.0}, at_s(3.0));
  ASSERT_TRUE(motion);
  EXPECT_NEAR((motion->T_odom_base.p - Eigen::Vector2d(0.0, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_GT(motion->pose_covariance(0, 0), motion->pose_covariance(1, 1));
}

TEST(WheelOdometry, WheelsThatAreMissingOrAtOnePlaceAreNamed) {
  WheelOdometryParams params = two_wheels();
  params.validate();
  params.wheel1->y = -0.15;
  EXPECT_THROW(params.validate(), Error);
  params.wheel1.reset();
  EXPECT_THROW(params.validate(), Error);
  params.count = 1;
  params.validate();
}

FakeFix fix_after_a_second(FakeGps& receiver, const Eigen::Vector3d& to) {
  receiver.at(at_s(1.0), {0.0, 0.0, 0.0});
  return *receiver.at(at_s(2.0), to);
}

TEST(FakeGps, APlaceOfTheMapIsOneOnTheEarthAndItsSpeedIsInNed) {
  const FakeGpsParams params;
  FakeGps receiver(params);
  const FakeFix fix = fix_after_a_second(receiver, {3.0, 4.0, 2.0});
  const auto payload = hil_gps_payload(fix, params, 48.0);
  EXPECT_EQ(payload.time_usec, 2'000'000U);
  EXPECT_NEAR(payload.lat * 1e-7, 47.3667 + 4.0 / 111'186.0, 1e-7);  // of a degree there [m]
  EXPECT_NEAR(payload.lon * 1e-7, 8.55 + 3.0 / 75'500.0, 1e-6);
  EXPECT_NEAR(payload.alt, (408.0 + 2.0 - 48.0) * 1e3, 2.0);
  EXPECT_EQ(payload.vn, 400);
  EXPECT_EQ(payload.ve, 300);
  EXPECT_EQ(payload.vd, -200);
  EXPECT_EQ(payload.vel, 500);
  EXPECT_EQ(payload.cog, 3687);
  EXPECT_EQ(payload.eph, 200);
  EXPECT_EQ(payload.satellites_visible, 5);
}

TEST(FakeGps, TheFirstFixHasNoSpeedAndAStandingOneNoCourse) {
  FakeGpsParams params;
  params.use_hil_gps = false;
  FakeGps receiver(params);
  const auto first = receiver.at(at_s(1.0), {0.0, 0.0, 0.0});
  ASSERT_TRUE(first);
  EXPECT_EQ(hil_gps_payload(*first, params, 0.0).vel, UINT16_MAX);
  EXPECT_EQ(gps_input_payload(*first, params, 0.0).ignore_flags,
            GPS_INPUT_IGNORE_FLAG_SPEED_ACCURACY | GPS_INPUT_IGNORE_FLAG_VEL_HORIZ |
                GPS_INPUT_IGNORE_FLAG_VEL_VERT);
  const auto second = receiver.at(at_s(2.0), {0.0, 0.0, 0.0});
  EXPECT_EQ(hil_gps_payload(*second, params, 0.0).cog, UINT16_MAX);
  EXPECT_EQ(gps_input_payload(*second, params, 0.0).ignore_flags,
            GPS_INPUT_IGNORE_FLAG_SPEED_ACCURACY);
}

TEST(FakeGps, AWestwardCourseIsClockwiseFromNorth) {
  const FakeGpsParams params;
  FakeGps receiver(params);
  EXPECT_EQ(hil_gps_payload(fix_after_a_second(receiver, {-1.0, 0.0, 0.0}), params, 0.0).cog,
            27000);
}

TEST(FakeGps, TheWeekIsThatOfGps) {
  const FakeGpsParams params;
  FakeGps receiver(params);
  FakeFix fix = fix_after_a_second(receiver, {1.0, 0.0, 0.0});
  fix.unix_ns = 1'767'225'600'250'000'000;  // 2026-01-01T00:00:00.25Z, a Thursday
  const auto payload = gps_input_payload(fix, params, 0.0);
  EXPECT_EQ(payload.time_week, 2399);
  EXPECT_EQ(payload.time_week_ms, (4U * 86'400U + 18U) * 1000U + 250U);
}

TEST(FakeGps, PosesBetweenTwoFixesAreNotSent) {
  FakeGps receiver{FakeGpsParams()};  // 5 Hz
  int sent = 0;
  for (int i = 0; i < 100; ++i) sent += receiver.at(at_s(0.02 * i), {0.1 * i, 0.0, 0.0}) ? 1 : 0;
  EXPECT_EQ(sent, 10);
  EXPECT_TRUE(receiver.at(at_s(0.0), {0.0, 0.0, 0.0}));  // time went back
}

TEST(FollowedRate, NewPosesAreDueAtTheirRate) {
  FollowedRate rate(10.0);
  EXPECT_TRUE(rate.is_due(ros::Time(5.0)));
  EXPECT_FALSE(rate.is_due(ros::Time(5.0)));
  EXPECT_FALSE(rate.is_due(ros::Time(5.05)));
  EXPECT_TRUE(rate.is_due(ros::Time(5.1)));
  EXPECT_TRUE(rate.is_due(ros::Time(1.0)));
  FollowedRate fixed(10.0);  // a static transform has no stamp
  EXPECT_TRUE(fixed.is_due(ros::Time()));
  EXPECT_FALSE(fixed.is_due(ros::Time()));
}

TEST(RecentVariance, IsThatOfTheNewestFifty) {
  RecentVariance recent;
  EXPECT_EQ(recent.add(7.0), 0.0);
  EXPECT_DOUBLE_EQ(recent.add(9.0), 1.0);
  for (int i = 0; i < 49; ++i) recent.add(3.0);
  EXPECT_DOUBLE_EQ(recent.add(3.0), 0.0);
}

}  // namespace
}  // namespace trident::mavros
