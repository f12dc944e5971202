// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "marine/vessel/thruster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "marine/vessel/rudder.h"
#include "test_world.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

ThrusterParams params_of(ThrustMapping mapping) {
  ThrusterParams params;
  params.name = "left";
  params.position = {-2.0, 1.0, 0.3};
  params.mapping = mapping;
  return params;
}

double settled(const ThrusterParams& params, double command) {
  Thruster thruster(params);
  thruster.command(command);
  thruster.step(1.0);
  return thruster.thrust_n();
}

TEST(Thruster, LinearIsAsymmetricAndSaturates) {
  const ThrusterParams params = params_of(ThrustMapping::kLinear);
  EXPECT_NEAR(settled(params, 0.5), 125.0, 1e-9);
  EXPECT_NEAR(settled(params, -0.5), -50.0, 1e-9);
  EXPECT_NEAR(settled(params, 7.0), 250.0, 1e-9);
  EXPECT_NEAR(settled(params, -7.0), -100.0, 1e-9);
}

/// Values of VRX' formula, worked out apart.
TEST(Thruster, GlfIsVrxCurve) {
  EXPECT_NEAR(vrx_glf_thrust(1.0), 0.01 + 59.81 / std::pow(0.56 + std::exp(-3.6), 1 / 0.38), 1e-9);
  EXPECT_NEAR(vrx_glf_thrust(-1.0),
              -199.13 + 199.04 / std::pow(0.99 + std::exp(8.84 * 0.43), 1 / 5.34), 1e-9);
  EXPECT_EQ(vrx_glf_thrust(0.005), 0.0);
  EXPECT_EQ(vrx_glf_thrust(-0.01), 0.0);
  EXPECT_GT(vrx_glf_thrust(1.0), 200.0);
  EXPECT_LT(vrx_glf_thrust(-1.0), -90.0);
  EXPECT_EQ(vrx_glf_thrust(2.0), vrx_glf_thrust(1.0));
  for (double x = -0.98; x <= 1.0; x += 0.02) {
    EXPECT_GE(vrx_glf_thrust(x), vrx_glf_thrust(x - 0.02)) << x;
  }
}

TEST(Thruster, QuadraticHasACoefficientInEitherDirection) {
  ThrusterParams params = params_of(ThrustMapping::kQuadratic);
  params.min_command = -100.0;
  params.max_command = 100.0;
  params.coefficient_forward = 0.01;
  params.coefficient_reverse = 0.006;
  EXPECT_NEAR(settled(params, 50.0), 25.0, 1e-9);
  EXPECT_NEAR(settled(params, -50.0), -15.0, 1e-9);
  params.coefficient_reverse = 0.0;
  EXPECT_TRUE(contains(error_of([&] { Thruster{params}; }), "coefficient_reverse = 0"));
}

TEST(Thruster, TableIsLinearBetweenItsPoints) {
  ThrusterParams params = params_of(ThrustMapping::kTable);
  params.table_commands = {-1.0, 0.0, 0.5, 1.0};
  params.table_forces = {-20.0, 0.0, 5.0, 33.0};
  EXPECT_NEAR(settled(params, 0.25), 2.5, 1e-9);
  EXPECT_NEAR(settled(params, 0.75), 19.0, 1e-9);
  EXPECT_NEAR(settled(params, -0.5), -10.0, 1e-9);
  EXPECT_NEAR(settled(params, 1.0), 33.0, 1e-9);
  params.table_forces.pop_back();
  EXPECT_TRUE(contains(error_of([&] { Thruster{params}; }), "4 numbers, table_forces 3"));
}

TEST(Thruster, FollowsItsCommandWithALagThatIgnoresTheStep) {
  ThrusterParams params = params_of(ThrustMapping::kLinear);
  params.time_constant = 0.5;
  for (const int steps : {5, 500}) {
    Thruster thruster(params);
    thruster.command(1.0);
    for (int i = 0; i < steps; ++i) thruster.step(0.5 / steps);
    EXPECT_NEAR(thruster.state_value(), 1.0 - std::exp(-1.0), 1e-12);
  }
}

TEST(Thruster, DeadBandDoesNothing) {
  ThrusterParams params = params_of(ThrustMapping::kLinear);
  params.dead_band = 0.1;
  EXPECT_EQ(settled(params, 0.09), 0.0);
  EXPECT_EQ(settled(params, -0.09), 0.0);
  EXPECT_NEAR(settled(params, 0.1), 25.0, 1e-9);
}

TEST(Thruster, BadCommandsAreNamedAndTheLastGoodOneStays) {
  Thruster thruster(params_of(ThrustMapping::kLinear));
  thruster.command(0.5);
  const double bad[] = {std::nan(""), std::numeric_limits<double>::infinity()};
  for (const double value : bad) {
    EXPECT_TRUE(
        contains(error_of([&] { thruster.command(value); }), "thruster 'left': command = "));
    EXPECT_TRUE(contains(error_of([&] { thruster.command_angle(value); }), "angle = "));
  }
  EXPECT_EQ(thruster.command_value(), 0.5);
  EXPECT_TRUE(contains(thruster.check_command(1.5), "command = 1.5, legal is [-1, 1]"));
  EXPECT_EQ(thruster.check_command(-1.0), "");
}

TEST(Thruster, WrenchIsForceAndLever) {
  ThrusterParams params = params_of(ThrustMapping::kLinear);
  params.max_angle = 0.5;
  params.angle_rate = 0.2;
  Thruster thruster(params);
  thruster.command(0.4);
  thruster.command_angle(2.0);
  thruster.step(1.0);
  EXPECT_NEAR(thruster.angle_rad(), 0.2, 1e-12);
  Vector6d expected;
  expected << 100 * std::cos(0.2), 100 * std::sin(0.2), 0, -0.3 * 100 * std::sin(0.2),
      0.3 * 100 * std::cos(0.2), -2.0 * 100 * std::sin(0.2) - 1.0 * 100 * std::cos(0.2);
  EXPECT_LT((thruster.wrench() - expected).norm(), 1e-9);
  thruster.step(9.0);
  EXPECT_NEAR(thruster.angle_rad(), 0.5, 1e-12);
  thruster.reset();
  EXPECT_EQ(thruster.wrench().norm(), 0.0);
}

RudderParams rudder_params() {
  RudderParams params;
  params.name = "rudder";
  params.position = {-1.0, 0.0, -0.2};
  params.area = 0.05;
  return params;
}

TEST(Rudder, LiftsAsAWingOfLowAspectRatio) {
  Rudder rudder(rudder_params());
  rudder.command(0.1);
  rudder.step(1.0);
  Vector6d nu = Vector6d::Zero();
  nu[0] = 2.0;
  const Vector6d wrench = rudder.wrench(nu, 1000.0);
  const double slope = 2 * kPi * 1.5 / (2.0 + 2.5);
  EXPECT_NEAR(wrench[1], -0.5 * 1000 * 4 * 0.05 * slope * 0.1, 1e-9);
  EXPECT_LT(wrench[0], 0.0);
  EXPECT_NEAR(wrench[5], -1.0 * wrench[1], 1e-9);  // a positive angle turns to port
  EXPECT_GT(wrench[5], 0.0);
}

TEST(Rudder, TakesEnergyWhateverTheFlow) {
  Rudder rudder(rudder_params());
  rudder.command(0.6);
  rudder.step(10.0);
  EXPECT_EQ(rudder.angle_rad(), 0.6);
  for (double course = -3.1; course < 3.1; course += 0.05) {
    Vector6d nu = Vector6d::Zero();
    nu.head<2>() << std::cos(course), std::sin(course);
    EXPECT_LT(nu.dot(rudder.wrench(nu, 1000.0)), 0.0) << course;
  }
  EXPECT_TRUE(contains(error_of([&] { rudder.command(std::nan("")); }), "rudder 'rudder': angle"));
}

}  // namespace
}  // namespace trident::sim
