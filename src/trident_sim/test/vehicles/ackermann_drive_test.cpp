// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// A car on its wheels against Ackermann's geometry.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "car.h"
#include "trident_base/angle.h"
#include "trident_base/vehicle/bicycle_odometry.h"

namespace trident::sim {
namespace {

const AckermannGeometry kGeometry{0.6, 0.4, 0.4};

CarOptions with(ParamList params) {
  CarOptions options;
  options.params = std::move(params);
  return options;
}

/// The gains are upstream's kind, for a car of 12 kg.
ParamList by_efforts() {
  return {{"left_steering_pid_gain", "40 0 2"},
          {"right_steering_pid_gain", "40 0 2"},
          {"linear_velocity_pid_gain", "5 0 0"}};
}

std::string refusal(const CarOptions& options) {
  return error_of([&] { CarWorld car(options); });
}

const DiagnosticEntry* entry(CarWorld& car, const std::string& kind) {
  const auto& entries = car.world->diagnostics().entries();
  const auto found = entries.find("model 'car' plugin 'drive': " + kind);
  return found == entries.end() ? nullptr : &found->second;
}

TEST(AckermannDrive, ItsSmallestCircleIsWheelbaseOverTanMaxSteer) {
  for (const double max_steer : {0.2, 0.4, 0.6}) {
    CarWorld car(with({{"max_steer", std::to_string(max_steer)}, {"acceleration", "1"}}));
    car.command(0.5, 2.0);
    car.run(2.0);
    const double expected = 0.6 / std::tan(max_steer);
    EXPECT_NEAR(car.radius(1.0), expected, 0.02 * expected) << max_steer;
  }
}

TEST(AckermannDrive, TheWheelsStandAtTheirAngles) {
  CarWorld car;
  for (const double steering : {0.3, -0.5}) {
    car.command(0.5, steering);
    car.run(2.0);
    EXPECT_NEAR((car.wheel_angles() - kGeometry.wheel_angles(steering)).norm(), 0.0, 0.01);
    EXPECT_NEAR(car.model->canonical_link()->w_world().z(), 0.5 * std::tan(steering) / 0.6, 0.01);
  }
}

/// Upstream's: angular.z turns in the same direction ahead and back.
TEST(AckermannDrive, BackwardsItTurnsInTheDirectionThatIsCommanded) {
  CarWorld car;
  car.command(-0.5, 0.4);
  car.run(2.0);
  EXPECT_GT(car.model->canonical_link()->w_world().z(), 0.3);
  EXPECT_LT(car.wheel_angles()[0], -0.3);
  EXPECT_NEAR(car.radius(0.5), 0.6 / std::tan(0.4), 0.02 * 0.6 / std::tan(0.4));
}

TEST(AckermannDrive, AYawRateIsOneWhenAskedFor) {
  CarWorld car(with({{"angular_command", "yaw_rate"}}));
  for (const double speed : {0.5, -0.8}) {
    car.command(speed, 0.3);
    car.run(3.0);
    EXPECT_NEAR(car.model->canonical_link()->w_world().z(), 0.3, 0.01);
  }
}

TEST(AckermannDrive, ItReachesItsSpeedAlongARamp) {
  CarWorld car(with({{"acceleration", "0.5"}, {"update_rate", "0"}}));
  car.run(0.2);
  car.command(1.0, 0.0);
  car.run(1.0);
  EXPECT_NEAR(car.odometry->value.v_child.x(), 0.5, 0.01);
  car.run(2.0);
  EXPECT_NEAR(car.odometry->value.v_child.x(), 1.0, 1e-3);
  EXPECT_NEAR(car.truth().p.y(), 0.0, 1e-3);
}

/// The base is 0.2 m ahead of the axle: odometry is that of the base, with its sideways velocity.
TEST(AckermannDrive, TheEncodersMeasureTheMotionOfTheBase) {
  CarWorld car(with({{"odometry_source", "encoder"}, {"acceleration", "1"}}));
  for (const double steering : {0.4, -0.3, 0.0}) {
    car.command(0.6, steering);
    car.run(4.0);
  }
  const double distance = 0.6 * 12.0;
  EXPECT_LT((car.reported_pose().p - car.truth().p).norm(), 0.01 * distance);
  EXPECT_NEAR(angle_difference(car.reported_pose().angle, car.truth().angle), 0.0, 0.03);
  car.command(0.6, 0.4);
  car.run(2.0);
  const double rate = 0.6 * std::tan(0.4) / 0.6;
  EXPECT_NEAR(car.odometry->value.w_child.z(), rate, 0.01);
  EXPECT_NEAR(car.odometry->value.v_child.x(), 0.6, 0.005);
  EXPECT_NEAR(car.odometry->value.v_child.y(), 0.2 * rate, 0.005);
}

TEST(AckermannDrive, OnIceTheEncodersReportALongerPath) {
  CarOptions options = with({{"odometry_source", "encoder"}, {"acceleration", "2"}});
  options.mu = 0.05;
  CarWorld car(options);
  car.command(2.0, 0.0);
  car.run(2.0);
  EXPECT_GT(car.reported_pose().p.x(), 1.05 * car.truth().p.x());
}

TEST(AckermannDrive, TheEncodersCovarianceGrowsWhenAsked) {
  CarWorld car(with({{"odometry_source", "encoder"},
                     {"acceleration", "1"},
                     {"encoder_error_per_meter", "1e-4"},
                     {"encoder_turn_error_per_meter", "1e-3"}}));
  car.command(1.0, 0.0);
  car.run(4.0);
  const double distance = car.reported_pose().p.x();
  const Covariance6& covariance = car.odometry->value.pose_covariance;
  EXPECT_NEAR(covariance[0], 1e-4 * distance, 1e-6);
  EXPECT_NEAR(covariance[35], 1e-3 * distance, 1e-5);
  // The axle's, and that of the base ahead of it.
  const double of_axle = 1e-3 * distance * distance * distance / 3.0;
  EXPECT_GT(covariance[7], of_axle);
  EXPECT_NEAR(covariance[7],
              of_axle + 2 * 0.2 * 1e-3 * distance * distance / 2 + 0.04 * 1e-3 * distance, 1e-4);
}

TEST(AckermannDrive, UpstreamsGainsDriveItByEfforts) {
  CarOptions options = with(by_efforts());
  for (const bool universal : {false, true}) {
    options.universal = universal;
    CarWorld car(options);
    car.command(0.8, 0.4);
    car.run(4.0);
    const double expected = 0.6 / std::tan(0.4);
    EXPECT_NEAR(car.radius(1.0), expected, 0.04 * expected) << universal;
    EXPECT_NEAR(car.odometry->value.v_child.x(), 0.8, 0.05) << universal;
    car.world->reset();
    car.run(1.0);
    EXPECT_NEAR(car.truth().p.norm(), 0.0, 0.01) << "a reset forgets the command";
  }
}

TEST(AckermannDrive, WhatItCannotDoIsCutAndCounted) {
  CarWorld car(with({{"max_speed", "1"}, {"max_steer", "0.3"}}));
  for (int i = 0; i < 3; ++i) {
    car.command(2.5, 0.9);
    car.run(0.5);
  }
  car.run(3.0);
  EXPECT_NEAR(car.odometry->value.v_child.x(), 1.0, 0.01);
  const DiagnosticEntry* speed = entry(car, "velocity command clamped");
  ASSERT_NE(speed, nullptr);
  EXPECT_EQ(speed->count, 3u);
  EXPECT_EQ(speed->newest.values[0].second, "2.500000 m/s");
  EXPECT_EQ(speed->newest.values[1].second, "[-1.000000, 1.000000] m/s");
  const DiagnosticEntry* steering = entry(car, "steering command clamped");
  ASSERT_NE(steering, nullptr);
  EXPECT_EQ(steering->newest.values[0].second, "0.900000 rad");
  EXPECT_EQ(car.world.report_count(Severity::kWarning, "2.500000 times its limit"), 1u);
  EXPECT_EQ(car.world.report_count(Severity::kWarning, "steering angle of 0.9"), 1u);
}

TEST(AckermannDrive, TheFastestWheelsJointLimitsTheSpeed) {
  CarOptions options;
  options.velocity_limit_rad_s = 5.0;  // 0.5 m/s at the rim
  CarWorld car(options);
  car.command(1.0, 0.5);
  car.run(3.0);
  const double outer = 1.0 + 0.5 * 0.4 / 0.6 * std::tan(0.5);
  const double yaw_rate = car.model->canonical_link()->w_world().z();
  EXPECT_NEAR(yaw_rate, 0.5 / outer * std::tan(0.5) / 0.6, 0.01);
  EXPECT_NE(entry(car, "velocity command clamped"), nullptr);
}

TEST(AckermannDrive, ACommandThatIsNotFiniteIsRefusedAndCounted) {
  CarWorld car;
  car.command(0.5, 0.0);
  car.run(1.0);
  car.command(std::nan(""), 0.1);
  car.command(0.1, std::numeric_limits<double>::infinity());
  car.run(1.0);
  EXPECT_NEAR(car.odometry->value.v_child.x(), 0.5, 1e-3);
  const DiagnosticEntry* refused = entry(car, "velocity command refused");
  ASSERT_NE(refused, nullptr);
  EXPECT_EQ(refused->count, 2u);
  EXPECT_EQ(refused->newest.severity, Severity::kError);
  EXPECT_EQ(car.world.report_count(Severity::kError, "must be finite"), 1u);
}

TEST(AckermannDrive, AStopOfTheJointBoundsTheSteering) {
  CarOptions options = with({{"max_steer", "0.6"}});
  options.steering_stop_rad = 0.5;
  CarWorld car(options);
  const DiagnosticEntry* clamped = entry(car, "max_steer clamped");
  ASSERT_NE(clamped, nullptr);
  car.command(0.5, 1.0);
  car.run(3.0);
  const double possible = kGeometry.steering_of_inner(0.5);
  EXPECT_NEAR(car.radius(1.0), 0.6 / std::tan(possible), 0.02 * 0.6 / std::tan(possible));
}

TEST(AckermannDrive, ElementsMayBeSpelledAsInRos1AndTopicsAsInRos2) {
  CarWorld camel(with({{"maxSteer", "0.3"},
                       {"odometryFrame", "o"},
                       {"robotBaseFrame", "b"},
                       {"publishDistance", "1"}}));
  EXPECT_EQ(camel.odometry->value.parent_frame, "o");
  EXPECT_EQ(camel.odometry->value.child_frame, "b");
  EXPECT_EQ(camel.world.report_count(Severity::kWarning, "have no effect"), 0u);
  auto* distance = camel.world->ports().find_out<ScalarSample>("distance");
  ASSERT_NE(distance, nullptr);
  distance->add_listener();
  camel.command(0.5, 0.0);
  camel.run(2.0);
  EXPECT_NEAR(distance->value.value, camel.truth().p.norm(), 1e-3);

  ModelSpec spec = make_car();
  spec.plugins[0].params.children.push_back({"ros",
                                             "",
                                             {},
                                             {{"namespace", "demo", {}, {}},
                                              {"remapping", " cmd_vel:=cmd_demo\n", {}, {}},
                                              {"remapping", "odom", {}, {}}}});
  TestWorld ros2;
  ros2.add(std::move(spec));
  EXPECT_NE(ros2->ports().find_in<TwistCommand>("demo/cmd_demo"), nullptr);
  EXPECT_NE(ros2->ports().find_out<OdometrySample>("demo/odom"), nullptr);
}

TEST(AckermannDrive, LengthsThatAreNotThoseOfTheWheelsAreNamed) {
  CarWorld car(with({{"wheel_base", "0.7"}, {"track_width", "0.4"}, {"wheel_radius", "0.1"}}));
  EXPECT_EQ(car.world.report_count(Severity::kWarning, "<wheel_base> is 0.700000 m"), 1u);
  EXPECT_EQ(car.world.report_count(Severity::kWarning, "track_width"), 0u);
}

TEST(AckermannDrive, BadValuesAreRefusedWithTheLegalOnes) {
  EXPECT_TRUE(contains(refusal(with({{"max_speed", "0"}})), "<max_speed> is '0'"));
  EXPECT_TRUE(contains(refusal(with({{"max_steer", "2"}})), "in [1e-06, 1.5]"));
  EXPECT_TRUE(contains(refusal(with({{"left_steering_pid_gain", "1 2"}})), "three finite numbers"));
  EXPECT_TRUE(contains(refusal(with({{"left_steering_pid_gain", "1 -2 0"}})), "gains >= 0"));
  EXPECT_TRUE(contains(
      refusal(with({{"linear_velocity_pid_gain", "1 0 0"}, {"linear_velocity_i_range", "5 0"}})),
      "two numbers about 0"));
  EXPECT_TRUE(
      contains(refusal(with({{"angular_command", "wheel"}})), "expected steering or yaw_rate"));
  EXPECT_TRUE(contains(refusal(with({{"rear_left_joint", "axle"}})), "a joint of the model"));
  EXPECT_TRUE(contains(
      refusal(with({{"front_left_joint", "front_right"}, {"front_right_joint", "front_left"}})),
      "the joint on the left"));
  CarOptions stiff;
  stiff.steering_stop_rad = 1e-4;
  EXPECT_TRUE(contains(refusal(stiff), "joints that can turn to both sides"));
  CarOptions universal;
  universal.universal = true;
  EXPECT_TRUE(contains(refusal(universal), "<left_steering_pid_gain> is '', expected gains"));
}

TEST(AckermannDrive, ASecondRunAfterAResetIsTheFirst) {
  CarWorld car(with({{"odometry_source", "encoder"}, {"acceleration", "0.7"}}));
  const auto run = [&car] {
    car.command(0.6, 0.4);
    car.run(1.5);
    return car.world->state_hash();
  };
  const std::string first = run();
  car.world->reset();
  EXPECT_EQ(run(), first);
}

}  // namespace
}  // namespace trident::sim
