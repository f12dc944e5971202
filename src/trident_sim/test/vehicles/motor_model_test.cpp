// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "quad_world.h"

namespace trident::sim {
namespace {

constexpr double kDt = 0.01, kGravity = 9.8;

TEST(MotorModel, SpeedRisesByTheUpConstant) {
  QuadWorld quad;
  quad.command_all(500.0);
  quad->step();
  const double one = 500.0 * (1.0 - std::exp(-kDt / quad.options.time_constant_up_s));
  EXPECT_NEAR(quad.rotor(0), -one, 1e-9);  // cw
  EXPECT_NEAR(quad.rotor(1), one, 1e-9);   // ccw
  quad->step(9);
  EXPECT_NEAR(quad.rotor(1), 500.0 * (1.0 - std::exp(-10 * kDt / quad.options.time_constant_up_s)),
              1e-9);
}

TEST(MotorModel, SpeedFallsByTheDownConstant) {
  QuadWorld quad;
  quad.settle({500, 500, 500, 500});
  quad.command_all(200.0);
  quad->step();
  EXPECT_NEAR(quad.rotor(1), 200.0 + 300.0 * std::exp(-kDt / quad.options.time_constant_down_s),
              1e-6);
}

TEST(MotorModel, SpeedIsLimited) {
  QuadWorld quad;
  quad.settle({5000, 5000, 5000, 5000});
  EXPECT_NEAR(quad.rotor(1), quad.options.max_speed_rad_s, 1e-6);
}

TEST(MotorModel, ThrustIsThatOfTheSpeedBeforeTheStep) {
  QuadWorld quad;
  quad.command_all(500.0);
  quad->step();
  EXPECT_NEAR(quad.body().velocity().z(), -kGravity * kDt, 1e-12);
  const double speed = quad.rotor(1);
  const double before = quad.body().velocity().z();
  quad->step();
  const double thrust = 4.0 * quad.options.motor_constant * speed * speed;
  EXPECT_NEAR(quad.body().velocity().z() - before,
              (thrust / quad.options.mass_kg() - kGravity) * kDt, 1e-12);
}

TEST(MotorModel, HoverSpeedCarriesTheWeight) {
  QuadWorld quad;
  quad.settle(std::vector<double>(4, quad.options.hover_speed_rad_s()));
  quad->step(100);
  EXPECT_LT(quad.body().velocity().norm(), 1e-6);
  EXPECT_LT(quad.body().angular_velocity().norm(), 1e-9);
}

/// Yaw acceleration with two of the rotors turning, by the direction of the pair.
double yaw_acceleration(QuadWorld& quad, const std::vector<double>& speeds) {
  quad.settle(speeds);
  quad->step();
  return quad.body().angular_velocity().z() / kDt;
}

TEST(MotorModel, DragTurnsTheBodyAgainstTheRotor) {
  QuadWorld cw, ccw;
  const double thrust = 2.0 * cw.options.motor_constant * 400.0 * 400.0;
  const double expected = thrust * cw.options.moment_constant / cw.body().inertia_tensor()(2, 2);
  EXPECT_NEAR(yaw_acceleration(cw, {400, 0, 400, 0}), expected, 0.01 * expected);
  EXPECT_NEAR(yaw_acceleration(ccw, {0, 400, 0, 400}), -expected, 0.01 * expected);
}

TEST(MotorModel, ThrustOfOneRotorTiltsTheBodyAwayFromIt) {
  QuadWorld quad;
  quad.settle({400, 0, 0, 0});  // the one at +x
  quad->step();
  EXPECT_LT(quad.body().angular_velocity().y(), 0.0);
  const double torque = quad.options.motor_constant * 400.0 * 400.0 * quad.options.arm_m;
  EXPECT_NEAR(-quad.body().angular_velocity().y() / kDt,
              torque / quad.body().inertia_tensor()(1, 1),
              0.05 * torque / quad.body().inertia_tensor()(1, 1));
}

/// Change of the twist in one step at 4 m/s along x, 1 m/s up, all rotors at 400 rad/s.
struct Change {
  Eigen::Vector3d linear, angular;
};
Change fly_sideways(const QuadOptions& options) {
  QuadWorld quad(options);
  quad.settle({400, 400, 400, 400});
  quad->set_model_twist(*quad.quad, {4, 0, 1}, Eigen::Vector3d::Zero());
  quad->step();
  return {(quad.body().velocity() - Eigen::Vector3d(4, 0, 1)) / kDt,
          quad.body().angular_velocity() / kDt};
}

TEST(MotorModel, RotorDragOpposesTheMotionAcrossTheAxis) {
  QuadOptions options;
  options.rotor_drag = 2e-4;
  const Change with = fly_sideways(options), without = fly_sideways({});
  const double expected = -4.0 * 400.0 * 2e-4 * 4.0 / options.mass_kg();
  EXPECT_TRUE(is_near(with.linear - without.linear, {expected, 0, 0}, 1e-6));
}

TEST(MotorModel, RollingMomentActsAlongTheMotion) {
  QuadOptions options;
  options.rolling_moment = 3e-5;
  const Change with = fly_sideways(options);
  const double torque = -4.0 * 400.0 * 3e-5 * 4.0;
  QuadWorld quad(options);
  EXPECT_NEAR(with.angular.x(), torque / quad.body().inertia_tensor()(0, 0), 1e-6);
  EXPECT_NEAR(with.angular.y(), 0.0, 1e-9);
}

TEST(MotorModel, SlowdownScalesTheJointOnly) {
  QuadOptions slow;
  slow.slowdown = 25.0;
  QuadWorld a, b(slow);
  for (QuadWorld* quad : {&a, &b}) {
    quad->world->ports().find_out<ScalarSample>("quad/motor_speed/1")->add_listener();
    quad->settle({450, 450, 450, 450});
    (*quad)->step(10);
  }
  EXPECT_NEAR(a.rotor(1), b.rotor(1), 1e-6);
  EXPECT_NEAR(a.body().velocity().z(), b.body().velocity().z(), 1e-9);
  EXPECT_NEAR(a->ports().find_out<ScalarSample>("quad/motor_speed/1")->value.value, 45.0, 1e-6);
  EXPECT_NEAR(b->ports().find_out<ScalarSample>("quad/motor_speed/1")->value.value, 18.0, 1e-6);
}

TEST(MotorModel, TwoRotorsTurningInTheSameDirectionHoldTheBodyGyroscopically) {
  QuadWorld quad;
  quad.settle({0, 600, 0, 600});
  quad->set_model_twist(*quad.quad, Eigen::Vector3d::Zero(), {1, 0, 0});
  quad->step();
  // h along +z, w along +x: -w x h is along +y.
  EXPECT_GT(quad.body().angular_velocity().y(), 0.0);
}

}  // namespace
}  // namespace trident::sim
