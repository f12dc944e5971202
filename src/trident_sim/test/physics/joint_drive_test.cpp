// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "models.h"
#include "test_world.h"
#include "trident_sim/world/joint_drive.h"

namespace trident::sim {
namespace {

constexpr double kInertia = 0.25;

/// A wheel on the world without gravity, hinged about z.
ModelSpec wheel(const ParamList& plugin = {}) {
  ModelSpec model;
  model.name = "m";
  model.links.push_back(make_link("wheel", 1.0, {0.2, 0.2, kInertia}));
  model.joints.push_back(make_joint("j", JointType::kRevolute, "world", "wheel", {}, {0, 0, 1}));
  if (!plugin.empty()) {
    model.plugins.push_back(make_plugin("drive", "libtrident_joint_drive.so", plugin));
  }
  return model;
}

struct WheelWorld {
  explicit WheelWorld(const ParamList& plugin = {}, double dt_s = 0.001)
      : world(weightless(dt_s)), model(&world.add(wheel(plugin))), joint(model->find_joint("j")) {}
  void load(double torque) {
    world->apply_wrench({model->links[0].get(), {0, 0, 0}, {0, 0, torque}, {0, 0, 0}, {}, {-1}});
  }
  TestWorld world;
  Model* model;
  Joint* joint;
};

PidGains gains(double p, double i, double d) {
  PidGains result;
  result.p = p;
  result.i = i;
  result.d = d;
  return result;
}

TEST(Pid, IsTheSumOfItsTermsWithinItsLimits) {
  PidGains limited = gains(2.0, 10.0, 0.5);
  limited.integral_limit = 3.0;
  limited.output_limit = 8.0;
  Pid pid(limited);
  EXPECT_DOUBLE_EQ(pid.update(1.0, -0.4, 0.1), 2.0 + 1.0 - 0.2);
  EXPECT_DOUBLE_EQ(pid.update(1.0, 0.0, 0.1), 2.0 + 2.0);
  for (int i = 0; i < 100; ++i) EXPECT_LE(pid.update(1.0, 0.0, 0.1), 5.0 + 1e-12);
  EXPECT_DOUBLE_EQ(pid.update(100.0, 0.0, 0.1), 8.0);
  // Unwound at once: the integral was clamped at 3.
  EXPECT_DOUBLE_EQ(pid.update(-0.1, 0.0, 0.1), -0.2 + 3.0 - 0.1);
  pid.reset();
  EXPECT_DOUBLE_EQ(pid.update(0.0, 0.0, 0.1), 0.0);
}

TEST(JointDrive, EffortAccelerates) {
  WheelWorld w;
  w.world->add_drive(*w.joint, {DriveMode::kEffort, {}, 0.5});
  w.world->step(1000);
  EXPECT_NEAR(w.joint->velocity(), 0.5 / kInertia, 1e-6);
  EXPECT_DOUBLE_EQ(w.world->find_drive(*w.joint)->effort(), 0.5);
}

TEST(JointDrive, ItsOwnLimitAndThatOfTheJointHold) {
  for (const double own : {0.2, 10.0}) {
    WheelWorld w;
    w.joint->axes[0].spec.effort = 0.4;
    DriveSpec spec{DriveMode::kEffort, {}, -5.0};
    spec.gains.output_limit = own;
    w.world->add_drive(*w.joint, spec);
    w.world->step(1000);
    EXPECT_NEAR(w.joint->velocity(), -std::min(own, 0.4) / kInertia, 1e-6);
  }
}

/// Of a wheel under p - d control x'' = p (target - x) / I - d x' / I: critically damped here.
TEST(JointDrive, PositionFollowsTheStepResponseOfSecondOrder) {
  WheelWorld w;
  const double rate = 5.0;
  w.world->add_drive(*w.joint, {DriveMode::kPosition,
                                gains(kInertia * rate * rate, 0.0, 2 * kInertia * rate), 0.0});
  w.world->find_drive(*w.joint)->set_target(1.0);
  for (int i = 1; i <= 2000; ++i) {
    w.world->step();
    const double t = 0.001 * i;
    ASSERT_NEAR(w.joint->position(), 1.0 - (1.0 + rate * t) * std::exp(-rate * t), 6e-3) << t;
  }
}

TEST(JointDrive, TheIntegralTakesAwayWhatALoadLeaves) {
  for (const double i : {0.0, 20.0}) {
    WheelWorld w;
    w.load(1.0);
    w.world->add_drive(*w.joint, {DriveMode::kPosition, gains(10.0, i, 3.0), 0.5});
    w.world->step(8000);
    EXPECT_NEAR(w.joint->position(), i > 0.0 ? 0.5 : 0.5 + 1.0 / 10.0, 1e-3);
  }
}

TEST(JointDrive, PositionsBeyondATurnAreReached) {
  WheelWorld w;
  w.world->add_drive(*w.joint, {DriveMode::kPosition, gains(10.0, 0.0, 3.0), -9.0});
  w.world->step(6000);
  EXPECT_NEAR(w.joint->position(), -9.0, 1e-3);
}

TEST(JointDrive, VelocityIsHeldAgainstALoad) {
  WheelWorld w;
  w.load(-0.3);
  w.world->add_drive(*w.joint, {DriveMode::kVelocity, gains(2.0, 10.0, 0.0), 4.0});
  w.world->step(5000);
  EXPECT_NEAR(w.joint->velocity(), 4.0, 1e-3);
  EXPECT_NEAR(w.world->find_drive(*w.joint)->effort(), 0.3, 1e-3);
}

TEST(JointDrive, ASecondDriveReplacesTheFirstAndRemovalEndsIt) {
  WheelWorld w;
  w.world->add_drive(*w.joint, {DriveMode::kEffort, {}, 5.0});
  w.world->add_drive(*w.joint, {DriveMode::kEffort, {}, 1.0});
  w.world->step(100);
  EXPECT_NEAR(w.joint->velocity(), 0.1 / kInertia, 1e-9);
  w.world->remove_drive(*w.joint);
  EXPECT_EQ(w.world->find_drive(*w.joint), nullptr);
  w.world->step(100);
  EXPECT_NEAR(w.joint->velocity(), 0.1 / kInertia, 1e-9);
}

TEST(JointDrive, AResetRepeatsTheRunAndTheModelTakesItAlong) {
  WheelWorld w;
  w.world->add_drive(*w.joint, {DriveMode::kVelocity, gains(1.0, 3.0, 0.01), 2.0});
  w.world->step(300);
  const std::string first = w.world->state_hash();
  w.world->find_drive(*w.joint)->set_target(-7.0);
  w.world->step(300);
  w.world->reset();
  w.world->step(300);
  EXPECT_EQ(w.world->state_hash(), first);
  w.world->remove("m");
  w.world->step(10);
}

TEST(JointDrive, BadValuesAreNamed) {
  WheelWorld w;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refusal = [&](const DriveSpec& spec, std::size_t axis = 0) {
    return error_of([&] { w.world->add_drive(*w.joint, spec, axis); });
  };
  EXPECT_TRUE(contains(refusal({DriveMode::kPosition, gains(1.0, nan, 0.0), 0.0}),
                       "drive of joint 'j' axis 0: gain i is nan, must be finite"));
  DriveSpec negative;
  negative.gains.output_limit = -1.0;
  EXPECT_TRUE(contains(refusal(negative), "output_limit is -1.000000, must be >= 0"));
  EXPECT_TRUE(contains(refusal({DriveMode::kEffort, {}, nan}), "target is nan, must be finite"));
  EXPECT_TRUE(contains(refusal({}, 1), "drive of joint 'j' axis 1: the joint has 1 axes"));
  JointDrive& drive = w.world->add_drive(*w.joint, {DriveMode::kEffort, {}, 1.0});
  error_of([&] { drive.set_target(nan); });
  EXPECT_DOUBLE_EQ(drive.target(), 1.0);
}

TEST(JointDrive, ARotorIsLeftToItsMotorModel) {
  TestWorld world;
  Model& quad = world.add(make_quad());
  EXPECT_TRUE(contains(error_of([&] { world->add_drive(*quad.find_joint("rotor_0_joint"), {}); }),
                       "is a rotor"));
}

const ParamList kPlugin{
    {"robotNamespace", "ns"}, {"jointName", "j"}, {"mode", "position"}, {"p", "10"}, {"d", "3"}};

TEST(JointDrivePlugin, FollowsItsPort) {
  WheelWorld w(kPlugin);
  auto* state = w.world->ports().find_out<ScalarSample>("ns/j/state");
  ASSERT_NE(state, nullptr);
  state->add_listener();
  w.world->ports().find_in<ScalarSample>("ns/j/command")->write({{}, 0.7});
  w.world->step(5000);
  EXPECT_NEAR(w.joint->position(), 0.7, 1e-3);
  EXPECT_DOUBLE_EQ(state->value.value, w.joint->position());
  EXPECT_EQ(state->value.stamp, w.world->time());
}

TEST(JointDrivePlugin, ATargetThatIsNotFiniteIsReportedOnceAndIgnored) {
  WheelWorld w(kPlugin);
  for (int i = 0; i < 3; ++i) {
    w.world->ports()
        .find_in<ScalarSample>("ns/j/command")
        ->write({{}, std::numeric_limits<double>::infinity()});
    w.world->step();
  }
  EXPECT_EQ(w.world.report_count(Severity::kError, "target is inf, must be finite"), 1u);
  EXPECT_DOUBLE_EQ(w.world->find_drive(*w.joint)->target(), 0.0);
}

TEST(JointDrivePlugin, ItsErrorsNameModelPluginAndJoint) {
  ParamList params = kPlugin;
  params[2].second = "torque";
  EXPECT_TRUE(contains(error_of([&] { WheelWorld{params}; }), "effort, velocity or position"));
  params = kPlugin;
  params.emplace_back("axis", "1");
  const std::string error = error_of([&] { WheelWorld{params}; });
  EXPECT_TRUE(contains(error, "model 'm' plugin 'drive'"));
  EXPECT_TRUE(contains(error, "drive of joint 'j' axis 1: the joint has 1 axes"));
}

}  // namespace
}  // namespace trident::sim
