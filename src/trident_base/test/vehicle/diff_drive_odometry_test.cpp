// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/vehicle/diff_drive_odometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/random_stream.h"

namespace trident {
namespace {

const DiffDriveOdometryParams kDrive{0.4, 0.1, 1e-4};

Eigen::Vector3d xy_yaw_of(const SE2& T) { return {T.p.x(), T.p.y(), T.angle}; }

TEST(DiffDriveOdometry, StraightAheadIsRadiusTimesAngle) {
  DiffDriveOdometry odometry(kDrive);
  odometry.update(3.0, 3.0);
  EXPECT_NEAR((xy_yaw_of(odometry.T_odom_base()) - Eigen::Vector3d(0.3, 0, 0)).norm(), 0, 1e-15);
  odometry.update(-1.0, -1.0);
  EXPECT_NEAR(odometry.distance_m(), 0.2, 1e-15);
}

TEST(DiffDriveOdometry, OneStepAlongAnArcEndsOnTheCircle) {
  for (const double turn : {1e-9, 1e-4, 1e-3, 0.5, 2.0, kPi, 5.0}) {
    const double radius = 1.5;
    DiffDriveOdometry odometry({0.4, 1.0, 0.0});
    odometry.update((radius - 0.2) * turn, (radius + 0.2) * turn);
    const SE2& T = odometry.T_odom_base();
    EXPECT_NEAR(T.p.x(), radius * std::sin(turn), 1e-14) << turn;
    EXPECT_NEAR(T.p.y(), radius * 2.0 * std::pow(std::sin(0.5 * turn), 2), 1e-14) << turn;
    EXPECT_NEAR(std::remainder(T.angle - turn, 2.0 * kPi), 0.0, 1e-14) << turn;
  }
}

TEST(DiffDriveOdometry, AnArcInPartsIsTheArc) {
  DiffDriveOdometry whole(kDrive), parts(kDrive);
  whole.update(7.0, 11.0);
  for (int i = 0; i < 100; ++i) parts.update(0.07, 0.11);
  EXPECT_NEAR((xy_yaw_of(whole.T_odom_base()) - xy_yaw_of(parts.T_odom_base())).norm(), 0, 1e-13);
}

TEST(WheelArc, ItsJacobiansAreThoseOfCentralDifferences) {
  const RandomStream stream(7, "arcs");
  for (std::uint64_t i = 0; i < 200; ++i) {
    const double left = stream.normal(i, 0), yaw = 3.0 * stream.normal(i, 2);
    // Some go straight on, where the quotients are replaced by series.
    const double right = i % 4 == 0 ? left + 1e-4 * stream.normal(i, 1) : stream.normal(i, 1);
    const double step = 1e-6;
    const auto after = [](double l, double r, double heading) {
      SE2 before;
      before.angle = heading;
      return xy_yaw_of(WheelArc(l, r, 0.4).applied_to(before));
    };
    const auto slope = [&](const Eigen::Vector3d& plus, const Eigen::Vector3d& minus) {
      Eigen::Vector3d change = plus - minus;
      change.z() = std::remainder(change.z(), 2.0 * kPi);
      return Eigen::Vector3d(change / (2.0 * step));
    };
    const WheelArc arc(left, right, 0.4);
    const auto travel = arc.jacobian_travel(yaw);
    EXPECT_NEAR(
        (travel.col(0) - slope(after(left + step, right, yaw), after(left - step, right, yaw)))
            .norm(),
        0.0, 1e-8);
    EXPECT_NEAR(
        (travel.col(1) - slope(after(left, right + step, yaw), after(left, right - step, yaw)))
            .norm(),
        0.0, 1e-8);
    EXPECT_NEAR((arc.jacobian_pose(yaw).col(2) -
                 slope(after(left, right, yaw + step), after(left, right, yaw - step)))
                    .norm(),
                0.0, 1e-8);
  }
}

/// Many runs with noisy encoders scatter as the covariance says.
TEST(DiffDriveOdometry, ItsCovarianceIsThatOfManyRuns) {
  const int runs = 4000, steps = 20;
  const double left = 0.9, right = 1.1;  // [rad] per step
  DiffDriveOdometry exact(kDrive);
  for (int i = 0; i < steps; ++i) exact.update(left, right);
  const RandomStream stream(3, "encoders");
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  std::uint64_t sample = 0;
  for (int run = 0; run < runs; ++run) {
    DiffDriveOdometry noisy({0.4, 0.1, 0.0});
    for (int i = 0; i < steps; ++i, ++sample) {
      const auto disturbed = [&](double angle, std::uint32_t channel) {
        const double sigma_m = std::sqrt(kDrive.travel_variance_m * 0.1 * angle);
        return angle + sigma_m / 0.1 * stream.normal(sample, channel);
      };
      noisy.update(disturbed(left, 0), disturbed(right, 1));
    }
    Eigen::Vector3d error = xy_yaw_of(noisy.T_odom_base()) - xy_yaw_of(exact.T_odom_base());
    error.z() = std::remainder(error.z(), 2.0 * kPi);
    scatter += error * error.transpose() / runs;
  }
  const Eigen::Matrix3d& covariance = exact.covariance();
  // The variance of a sample variance is 2 / runs of its square: four sigma.
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(scatter(i, i) / covariance(i, i), 1.0, 4.0 * std::sqrt(2.0 / runs));
  EXPECT_NEAR(scatter(1, 2) / std::sqrt(covariance(1, 1) * covariance(2, 2)),
              covariance(1, 2) / std::sqrt(covariance(1, 1) * covariance(2, 2)), 0.06);
  EXPECT_TRUE(covariance.isApprox(covariance.transpose()));
}

TEST(DiffDriveOdometry, ResetStartsAgain) {
  DiffDriveOdometry odometry(kDrive);
  odometry.update(3.0, 1.0);
  EXPECT_GT(odometry.covariance().norm(), 0.0);
  odometry.reset();
  EXPECT_EQ(xy_yaw_of(odometry.T_odom_base()).norm(), 0.0);
  EXPECT_EQ(odometry.covariance().norm(), 0.0);
  EXPECT_EQ(odometry.distance_m(), 0.0);
}

TEST(DiffDriveOdometry, BadValuesAreNamed) {
  const auto error_of = [](const DiffDriveOdometryParams& params) -> std::string {
    try {
      DiffDriveOdometry odometry(params);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(error_of({0.0, 0.1, 0.0}).find("wheel_separation_m is 0.0"), std::string::npos);
  EXPECT_NE(error_of({0.4, -0.1, 0.0}).find("wheel_radius_m is -0.1"), std::string::npos);
  EXPECT_NE(error_of({0.4, 0.1, -1.0}).find("travel_variance_m is -1.0"), std::string::npos);
  EXPECT_NE(error_of({0.4, std::nan(""), 0.0}).find("wheel_radius_m"), std::string::npos);
}

}  // namespace
}  // namespace trident
