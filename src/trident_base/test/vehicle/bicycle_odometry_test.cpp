// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/vehicle/bicycle_odometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/random_stream.h"

namespace trident {
namespace {

const AckermannGeometry kCar{2.5, 1.4, 1.5};
const BicycleOdometryParams kParams{2.5, 0.3, 1e-3, 2e-4};

Eigen::Vector3d vector_of(const SE2& T) { return {T.p.x(), T.p.y(), T.angle}; }

/// Every wheel is square to the line from it to the point that the car turns about.
TEST(AckermannGeometry, TheWheelsTurnAboutOnePoint) {
  for (const double steering : {-0.6, -0.1, 1e-6, 0.3, 0.7}) {
    const double radius = kCar.wheelbase_m / std::tan(steering);
    const Eigen::Vector2d angles = kCar.wheel_angles(steering);
    for (const int side : {0, 1}) {
      const double y = (side == 0 ? 0.5 : -0.5) * kCar.front_track_m;
      const Eigen::Vector2d to_center(-kCar.wheelbase_m, radius - y);
      const Eigen::Vector2d rolling(std::cos(angles[side]), std::sin(angles[side]));
      EXPECT_NEAR(rolling.dot(to_center.normalized()), 0.0, 1e-12) << steering;
    }
    const Eigen::Vector2d speeds = kCar.rear_speeds(3.0, steering);
    EXPECT_NEAR(speeds[0] / speeds[1],
                (radius - 0.5 * kCar.rear_track_m) / (radius + 0.5 * kCar.rear_track_m), 1e-9);
    EXPECT_NEAR(speeds.mean(), 3.0, 1e-12);
  }
  EXPECT_EQ(kCar.wheel_angles(0.0).norm(), 0.0);
}

TEST(AckermannGeometry, TheSteeringComesBackFromTheWheels) {
  for (double steering = -1.2; steering <= 1.2; steering += 0.1) {
    const Eigen::Vector2d angles = kCar.wheel_angles(steering);
    EXPECT_NEAR(kCar.steering_of(angles[0], angles[1]), steering, 1e-12);
    EXPECT_NEAR(kCar.steering_of_inner(angles.cwiseAbs().maxCoeff()), std::abs(steering), 1e-12);
  }
}

TEST(BicycleOdometry, OneStepEndsOnTheCircleOfWheelbaseOverTanSteering) {
  for (const double turn : {1e-9, 1e-4, 0.5, 2.0, 5.0}) {
    const double steering = 0.4, radius = 2.5 / std::tan(steering);
    BicycleOdometry odometry({2.5, 1.0, 0.0, 0.0});
    odometry.update(radius * turn, steering);
    EXPECT_NEAR(odometry.T_odom_axle().p.x(), radius * std::sin(turn), 1e-13) << turn;
    EXPECT_NEAR(odometry.T_odom_axle().p.y(), radius * (1.0 - std::cos(turn)), 1e-13) << turn;
    EXPECT_NEAR(std::remainder(odometry.T_odom_axle().angle - turn, 2.0 * kPi), 0.0, 1e-13);
  }
}

TEST(BicycleOdometry, ThereAndBackIsTheStart) {
  BicycleOdometry odometry(kParams);
  for (int i = 0; i < 50; ++i) odometry.update(0.2, 0.01 * i);
  for (int i = 49; i >= 0; --i) odometry.update(-0.2, 0.01 * i);
  EXPECT_NEAR(vector_of(odometry.T_odom_axle()).norm(), 0.0, 1e-12);
  EXPECT_GT(odometry.covariance().trace(), 0.0) << "errors do not cancel";
}

/// Many runs with disturbed travel and heading scatter as the covariance says, in whatever steps.
TEST(BicycleOdometry, ItsCovarianceIsThatOfManyRuns) {
  const int runs = 4000, steps = 20;
  const double rear_rad = 2.0, steering = 0.05, travel = 0.3 * rear_rad;
  BicycleOdometry exact(kParams), in_one(kParams);
  for (int i = 0; i < steps; ++i) exact.update(rear_rad, steering);
  const RandomStream stream(5, "car");
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  std::uint64_t sample = 0;
  for (int run = 0; run < runs; ++run) {
    BicycleOdometry noisy({2.5, 0.3, 0.0, 0.0});
    for (int i = 0; i < steps; ++i, ++sample) {
      const double distance =
          travel + std::sqrt(kParams.travel_variance_m * travel) * stream.normal(sample, 0);
      const double turn =
          travel * std::tan(steering) / 2.5 +
          std::sqrt(kParams.turn_variance_rad2_m * travel) * stream.normal(sample, 1);
      noisy.update(distance / 0.3, std::atan(turn * 2.5 / distance));
    }
    const Eigen::Vector3d error = vector_of(noisy.T_odom_axle()) - vector_of(exact.T_odom_axle());
    scatter += error * error.transpose() / runs;
  }
  const Eigen::Matrix3d& covariance = exact.covariance();
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(scatter(i, i) / covariance(i, i), 1.0, 5.0 * std::sqrt(2.0 / runs)) << i;
  }
  EXPECT_TRUE(covariance.isApprox(covariance.transpose()));
  EXPECT_NEAR(covariance(2, 2), steps * travel * kParams.turn_variance_rad2_m, 1e-12);
}

TEST(BicycleOdometry, ResetStartsAgain) {
  BicycleOdometry odometry(kParams);
  odometry.update(3.0, 0.2);
  odometry.reset();
  EXPECT_EQ(vector_of(odometry.T_odom_axle()).norm(), 0.0);
  EXPECT_EQ(odometry.covariance().norm(), 0.0);
}

TEST(BicycleOdometry, BadValuesAreNamed) {
  const auto error_of = [](auto&& params) -> std::string {
    try {
      validate(params);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(error_of(BicycleOdometryParams{0.0, 0.1, 0, 0}).find("wheelbase_m is 0.0"),
            std::string::npos);
  EXPECT_NE(error_of(BicycleOdometryParams{1, std::nan(""), 0, 0}).find("wheel_radius_m"),
            std::string::npos);
  EXPECT_NE(error_of(BicycleOdometryParams{1, 1, -1, 0}).find("travel_variance_m is -1.0"),
            std::string::npos);
  EXPECT_NE(error_of(BicycleOdometryParams{1, 1, 0, -1}).find("turn_variance_rad2_m is -1.0"),
            std::string::npos);
  EXPECT_NE(error_of(AckermannGeometry{1, -1, 1}).find("front_track_m is -1.0"), std::string::npos);
  EXPECT_EQ(error_of(kCar), "");
}

}  // namespace
}  // namespace trident
