// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Carts on their wheels against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cart.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

constexpr double kGravity = 9.8;

ParamList encoders(ParamList more = {}) {
  more.emplace_back("odometrySource", "encoder");
  return more;
}

CartOptions rover_with(ParamList params, double mu = 1.0) {
  CartOptions options;
  options.params = std::move(params);
  options.mu = mu;
  return options;
}

CartOptions four_wheels(double mu) {
  CartOptions options;
  options.four_wheels = true;
  options.mu = mu;
  return options;
}

/// Drives by what the odometry reports, as a user would.
void go_ahead(CartWorld& cart, double distance_m) {
  const Eigen::Vector2d start = cart.reported_pose().p;
  cart.command(1.0, 0.0);
  while ((cart.reported_pose().p - start).norm() < distance_m - 0.1) cart.run(0.01);
  while ((cart.reported_pose().p - start).norm() < distance_m - 1e-3) {
    cart.command(std::max(0.02, distance_m - (cart.reported_pose().p - start).norm()), 0.0);
    cart.run(0.01);
  }
  cart.command(0.0, 0.0);
  cart.run(0.5);
}

void turn_to(CartWorld& cart, double yaw_rad) {
  for (double error = 1.0; std::abs(error) > 1e-3;) {
    error = angle_difference(yaw_rad, cart.reported_pose().angle);
    cart.command(0.0, std::copysign(std::clamp(2.0 * std::abs(error), 0.02, 1.0), error));
    cart.run(0.01);
  }
  cart.command(0.0, 0.0);
  cart.run(0.5);
}

TEST(DiffDrive, ASquareOfAHundredMetersClosesWithinATenthOfAPercent) {
  CartWorld cart(rover_with(encoders({{"wheelAcceleration", "1"}})), 0.002);
  for (int side = 1; side <= 4; ++side) {
    go_ahead(cart, 25.0);
    turn_to(cart, side * 0.5 * kPi);
  }
  const Eigen::Vector2d reported = cart.reported_pose().p, true_end = cart.truth().p;
  EXPECT_LT(reported.norm(), 0.1) << "according to the encoders";
  EXPECT_LT((reported - true_end).norm(), 0.1) << "against where it is";
  RecordProperty("error_mm", static_cast<int>(1000.0 * (reported - true_end).norm()));
  EXPECT_LT(std::abs(angle_difference(cart.truth().angle, cart.reported_pose().angle)), 0.02);
}

TEST(DiffDrive, OnIceTheEncodersReportALongerPath) {
  CartWorld cart(rover_with(encoders({{"wheelAcceleration", "2"}}), 0.05));
  cart.command(2.0, 0.0);
  cart.run(2.0);
  EXPECT_GT(cart.reported_pose().p.x(), 1.05 * cart.truth().p.x());
  EXPECT_GT(cart.truth().p.x(), 0.1);
}

TEST(DiffDrive, WithGripTheyReportTheDistance) {
  CartWorld cart(rover_with(encoders({{"wheelAcceleration", "2"}}), 1.0));
  cart.command(2.0, 0.0);
  cart.run(2.0);
  EXPECT_NEAR(cart.reported_pose().p.x(), cart.truth().p.x(), 1e-3 * cart.truth().p.x());
}

TEST(DiffDrive, ItReachesTheSpeedThatIsCommandedAndNoOther) {
  for (const double speed : {0.2, 1.0, -0.7}) {
    CartWorld cart;
    cart.command(speed, 0.0);
    cart.run(3.0);
    EXPECT_NEAR(cart.speed(), speed, 1e-3 * std::abs(speed));
    EXPECT_NEAR(cart.truth().p.y(), 0.0, 1e-3);
  }
}

TEST(DiffDrive, ItTurnsAboutTheMiddleOfItsAxleAndAlongCircles) {
  CartWorld cart;
  cart.command(0.0, 1.0);
  cart.run(kPi);
  EXPECT_NEAR(cart.model->canonical_link()->w_world().z(), 1.0, 0.005);
  EXPECT_LT(cart.truth().p.norm(), 0.01);
  CartWorld circle;
  circle.command(0.5, 0.5);  // of 1 m about (0, 1)
  circle.run(5.0);
  // It starts rover_with a jerk, in which the wheels slip.
  EXPECT_NEAR((circle.truth().p - Eigen::Vector2d(0, 1)).norm(), 1.0, 0.02);
}

/// v^2 / (2 mu g) rover_with all wheels braked.
TEST(SkidSteer, BrakingIsLimitedByFriction) {
  for (const double mu : {0.1, 0.3}) {
    CartWorld cart(four_wheels(mu));
    const double speed = 1.5;
    cart.command(speed, 0.0);
    cart.run(3.0 + speed / (mu * kGravity));
    ASSERT_NEAR(cart.speed(), speed, 0.01);
    const double start = cart.truth().p.x();
    cart.command(0.0, 0.0);
    cart.run(3.0);
    const double expected = speed * speed / (2.0 * mu * kGravity);
    // The command is taken up to a period of the drive, 10 ms, later.
    EXPECT_NEAR(cart.truth().p.x() - start, expected, 0.02 * expected + 0.01 * speed) << mu;
  }
}

/// mu g from standstill, rover_with all wheels driven and none slow enough to grip.
TEST(SkidSteer, AccelerationIsLimitedByFriction) {
  CartWorld cart(four_wheels(0.2));
  cart.run(0.2);
  cart.command(5.0, 0.0);
  cart.run(1.01);
  EXPECT_NEAR(cart.speed(), 0.2 * kGravity, 0.03 * 0.2 * kGravity);
}

/// Or by the motors: their torque moves the cart and spins up the wheels.
TEST(SkidSteer, AccelerationIsLimitedByTorque) {
  CartOptions options = four_wheels(1.0);
  options.params = {{"torque", "0.1"}};
  CartWorld cart(options);
  cart.run(0.2);
  cart.command(50.0, 0.0);
  cart.run(1.01);
  const double rolling_mass = 4 * 0.5 * 0.5;  // I / r^2 of four discs of 0.5 kg
  EXPECT_NEAR(cart.speed(), 4 * 0.1 / 0.1 / (5.0 + 4 * 0.5 + rolling_mass), 0.01);
}

/// A braked cart holds on a slope up to atan(mu).
TEST(SkidSteer, ItSlipsOnASlopeBeyondTheAngleOfFriction) {
  const double mu = 0.4;
  for (const double part : {0.97, 1.03}) {
    const double angle = part * std::atan(mu);
    const SE3 T_slope = SE3::from_xyz_rpy({0, 0, 0}, 0, -angle, 0);
    CartOptions options = four_wheels(mu);
    options.T_world_model = T_slope;
    CartWorld cart(options, 0.001, T_slope);
    cart.run(0.5);
    const double before = cart.model->T_world_model().p.x();
    cart.run(2.0);
    const double slid = before - cart.model->T_world_model().p.x();
    const double pull = kGravity * (std::sin(angle) - mu * std::cos(angle));
    if (part < 1.0) {
      EXPECT_LT(std::abs(slid), 2e-3);
    } else {
      EXPECT_GT(slid, 0.5 * 0.5 * pull * 2.0 * 2.0 * std::cos(angle));
    }
  }
}

TEST(DiffDrive, OdometryOfTheWorldIsTheTruth) {
  CartOptions options = rover_with({{"updateRate", "0"}}, 0.05);
  options.T_world_model = SE3::from_xyz_rpy({3, -2, 0}, 0, 0, 0.5);
  CartWorld cart(options);
  cart.command(1.0, 0.7);
  cart.run(2.0);
  EXPECT_TRUE(is_near(cart.odometry->value.T_parent_child, cart.model->T_world_model(), 1e-12));
  EXPECT_EQ(cart.odometry->value.stamp, cart.world->time());
  EXPECT_NEAR(cart.odometry->value.v_child.x(), cart.speed(), 1e-4);
}

TEST(DiffDrive, OdometryOfEncodersStartsAtItsOrigin) {
  CartOptions options = rover_with(encoders({{"wheelAcceleration", "1"}}));
  options.T_world_model = SE3::from_xyz_rpy({3, -2, 0}, 0, 0, 0.5);
  CartWorld cart(options);
  cart.command(0.5, 0.3);
  cart.run(4.0);
  const SE3 T_start = options.T_world_model;
  const SE2 moved = SE2::projected(T_start.inverse() * cart.model->T_world_model());
  EXPECT_NEAR((cart.reported_pose().p - moved.p).norm(), 0.0, 0.01);
  EXPECT_NEAR(cart.reported_pose().angle, moved.angle, 0.02);
  EXPECT_NEAR(cart.odometry->value.v_child.x(), 0.5, 1e-3);
  EXPECT_NEAR(cart.odometry->value.w_child.z(), 0.3, 1e-3);
}

/// Separation and diameter that do not fit scale turn and distance.
TEST(DiffDrive, AWrongGeometryShowsAsItsRatio) {
  CartWorld narrow(rover_with(encoders({{"wheelSeparation", "0.36"}, {"wheelAcceleration", "1"}})));
  narrow.command(0.0, 0.5);
  narrow.run(4.0);
  EXPECT_NEAR(narrow.reported_pose().angle / narrow.truth().angle, 0.4 / 0.36, 0.03);
  CartWorld small(rover_with(encoders({{"wheelDiameter", "0.19"}, {"wheelAcceleration", "1"}})));
  small.command(0.5, 0.0);
  small.run(4.0);
  EXPECT_NEAR(small.reported_pose().p.x() / small.truth().p.x(), 0.19 / 0.2, 0.005);
  EXPECT_NEAR(small.speed(), 0.5 * 0.2 / 0.19, 0.005);
}

TEST(DiffDrive, ItsEncodersCovarianceGrowsWhenAsked) {
  CartWorld cart(rover_with(encoders({{"encoderErrorPerMeter", "1e-4"}})));
  cart.command(1.0, 0.0);
  cart.run(3.0);
  const Covariance6& covariance = cart.odometry->value.pose_covariance;
  const double distance = cart.reported_pose().p.x();
  // Straight on: half the sum of two wheels along, their difference over the separation in turn.
  EXPECT_NEAR(covariance[0], 0.5e-4 * distance, 1e-6);
  EXPECT_NEAR(covariance[35], 2e-4 * distance / 0.16, 1e-5);
  EXPECT_NEAR(covariance[7], 2e-4 / 0.16 * distance * distance * distance / 3.0, 1e-4);
  EXPECT_EQ(covariance[14], 1e12);
}

TEST(DiffDrive, TheRampOfSpeedIsItsAcceleration) {
  CartWorld cart(rover_with({{"wheelAcceleration", "0.5"}, {"updateRate", "0"}}));
  cart.run(0.2);
  cart.command(1.0, 0.0);
  cart.run(1.0);
  EXPECT_NEAR(cart.speed(), 0.5, 0.01);
  cart.run(2.0);
  EXPECT_NEAR(cart.speed(), 1.0, 0.001);
}

TEST(DiffDrive, StandsSoonAfterItsCommandHasTimedOutHoweverSlowItsRampIs) {
  CartWorld cart(rover_with({{"wheelAcceleration", "0.5"}, {"commandTimeout", "0.2"}}));
  for (int i = 0; i < 20; ++i) {
    cart.command(1.0, 0.0);
    cart.run(0.1);
  }
  EXPECT_NEAR(cart.speed(), 1.0, 0.05);
  cart.run(0.08);  // 0.18 s since the last command
  EXPECT_GT(cart.speed(), 0.9);
  cart.run(0.3);
  EXPECT_NEAR(cart.speed(), 0.0, 0.01);
  cart.command(0.3, 0.0);  // the next one drives it again
  cart.run(0.18);
  EXPECT_GT(cart.speed(), 0.05);
}

}  // namespace
}  // namespace trident::sim
