// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Ball and universal joints, springs and turns against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "test_world.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

constexpr double kHalfTurn_rad = 3.14159265358979323846, kGravity_m_s2 = 9.8;

TEST(Ball, AConicalPendulumGoesRoundAtItsRate) {
  TestWorld world(world_spec(0.001));
  const double length = 1.0, angle = 0.6;
  const Eigen::Vector3d p(length * std::sin(angle), 0, -length * std::cos(angle));
  // A point mass turning about the vertical: w^2 = g / (l cos(angle)).
  Model& model =
      world.add(make_on_world(JointType::kBall, p, {0, 0, 1}, Eigen::Vector3d::Constant(1e-6)));
  const double rate = std::sqrt(kGravity_m_s2 / (length * std::cos(angle)));
  const Eigen::Vector3d w(0, 0, rate);
  world->set_link_state(*model.links[0], model.links[0]->T_world_link(), w.cross(p), w);
  for (int i = 0; i < 2000; ++i) {
    world->step();
    const Eigen::Vector3d now = model.links[0]->T_world_link().p;
    ASSERT_NEAR(now.norm(), length, 2e-3);
    ASSERT_NEAR(now.z(), p.z(), 0.01);
  }
  const Eigen::Vector3d end = model.links[0]->T_world_link().p;
  const double expected = std::remainder(2.0 * rate, 2 * kHalfTurn_rad);
  EXPECT_NEAR(std::remainder(std::atan2(end.y(), end.x()) - expected, 2 * kHalfTurn_rad), 0.0,
              0.02);
}

TEST(Ball, TurnsFreelyAboutAllAxes) {
  TestWorld world(weightless());
  Model& model = world.add(
      make_on_world(JointType::kBall, {0, 0, 0}, {0, 0, 1}, Eigen::Vector3d::Constant(0.1)));
  const Eigen::Vector3d w(1.0, -2.0, 0.5);
  world->set_link_state(*model.links[0], {}, {0, 0, 0}, w);
  world->step(1000);
  EXPECT_TRUE(is_near(model.bodies[0]->angular_velocity(), w, 1e-6));
  EXPECT_EQ(model.find_joint("j")->axis_count(), 0u);
  EXPECT_TRUE(contains(error_of([&] {
                         world->apply_effort({model.find_joint("j"), 1.0, {}, {-1}});
                       }),
                       "joint 'j' has 0 axes"));
}

ModelSpec universal(const Eigen::Vector3d& axis, const Eigen::Vector3d& axis2) {
  ModelSpec model = make_on_world(JointType::kUniversal, {0, 0, 0}, axis);
  model.joints[0].axis2.axis_model = axis2;
  return model;
}

TEST(Universal, ReadsTheTwoAnglesInTheOrderOfItsAxes) {
  TestWorld world(weightless());
  Model& model = world.add(universal({1, 0, 0}, {0, 1, 0}));
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(-0.4, Eigen::Vector3d::UnitY()));
  const Eigen::Vector3d rates(0.3, 0.5, 0.0);
  const Eigen::Vector3d second = turned * Eigen::Vector3d::UnitY();
  world->set_link_state(*model.links[0], {turned, {0, 0, 0}}, {0, 0, 0},
                        rates.x() * Eigen::Vector3d::UnitX() + rates.y() * second);
  const Joint& joint = *model.find_joint("j");
  ASSERT_EQ(joint.axis_count(), 2u);
  EXPECT_NEAR(joint.position(0), 0.7, 1e-9);
  EXPECT_NEAR(joint.position(1), -0.4, 1e-9);
  EXPECT_NEAR(joint.velocity(0), 0.3, 1e-9);
  EXPECT_NEAR(joint.velocity(1), 0.5, 1e-9);
}

TEST(Universal, LetsTheTwoAxesTurnAndHoldsTheThird) {
  TestWorld world(weightless());
  ModelSpec spec = universal({1, 0, 0}, {0, 1, 0});
  spec.links[0].inertial.inertia_com = 0.1 * Eigen::Matrix3d::Identity();
  Model& model = world.add(std::move(spec));
  Joint& joint = *model.find_joint("j");
  world->apply_effort({&joint, 0.02, {}, {-1}, 0});
  world->apply_effort({&joint, -0.01, {}, {-1}, 1});
  world->apply_wrench({model.links[0].get(), {0, 0, 0}, {0, 0, 0.04}, {0, 0, 0}, {}, {-1}});
  world->step(500);
  // About each axis torque / inertia t^2 / 2; the push about z is held.
  EXPECT_NEAR(joint.position(0), 0.2 * 0.125, 2e-3);
  EXPECT_NEAR(joint.position(1), -0.1 * 0.125, 2e-3);
  // Free it would have turned by 0.05 rad.
  EXPECT_NEAR((model.links[0]->T_world_link().R * Eigen::Vector3d::UnitY()).x(), 0.0, 2e-3);
}

class UniversalLimit : public testing::TestWithParam<std::pair<int, bool>> {};

TEST_P(UniversalLimit, StopsItsOwnAxisAtItsOwnEnd) {
  const auto [axis, is_child_static] = GetParam();
  TestWorld world(weightless());
  ModelSpec spec = universal({1, 0, 0}, {0, 1, 0});
  AxisSpec& limited = axis == 0 ? static_cast<AxisSpec&>(spec.joints[0]) : spec.joints[0].axis2;
  limited.lower = -0.2;
  limited.upper = 0.5;
  if (is_child_static) {  // the link that moves is the parent
    spec.links.push_back(make_link("base", 1.0, {1, 1, 1}));
    spec.joints.push_back(make_joint("fix", JointType::kFixed, "world", "base", {}, {0, 0, 1}));
    spec.joints[0].parent = "bob";
    spec.joints[0].child = "base";
  }
  Model& model = world.add(std::move(spec));
  Joint& joint = *model.find_joint("j");
  for (const double effort : {0.05, -0.05}) {
    world->apply_effort({&joint, effort, {}, {-1}, static_cast<std::size_t>(axis)});
    world->step(3000);
    EXPECT_NEAR(joint.position(axis), effort > 0 ? 0.5 : -0.2, 0.01);
    EXPECT_NEAR(joint.position(1 - axis), 0.0, 0.01);
    world->clear_efforts(joint);
  }
}
INSTANTIATE_TEST_SUITE_P(Axes, UniversalLimit,
                         testing::Values(std::pair{0, false}, std::pair{1, false},
                                         std::pair{0, true}, std::pair{1, true}));

TEST(Universal, AxesThatAreNotAtRightAnglesAreRefused) {
  TestWorld world;
  const std::string error = error_of([&] {
    world.add(universal({1, 0, 0}, Eigen::Vector3d(1, 1, 0).normalized()));
  });
  EXPECT_TRUE(contains(error, "joint 'j'"));
  EXPECT_TRUE(contains(error, "must be pi/2"));
  EXPECT_EQ(world->find_model("m"), nullptr);
}

TEST(Spring, SwingsAtItsFrequencyAboutItsReference) {
  TestWorld world(weightless());
  ModelSpec spec = make_on_world(JointType::kPrismatic, {0, 0, 0}, {1, 0, 0});
  spec.joints[0].spring_stiffness = 40.0;
  spec.joints[0].spring_reference = 0.1;
  Model& model = world.add(std::move(spec));
  const Joint& joint = *model.find_joint("j");
  // From 0 at rest: x = 0.1 (1 - cos(w t)).
  const double w = std::sqrt(40.0);
  for (int i = 1; i <= 3000; ++i) {
    world->step();
    ASSERT_NEAR(joint.position(), 0.1 * (1 - std::cos(w * 0.001 * i)), 2e-3) << i;
  }
}

TEST(Spring, AStiffOneIsStable) {
  TestWorld world(weightless(0.01));
  ModelSpec spec = make_on_world(JointType::kRevolute, {0, 0, 0}, {0, 0, 1});
  spec.joints[0].spring_stiffness = 1e6;
  spec.joints[0].spring_reference = 0.5;
  spec.joints[0].damping = 1.0;
  Model& model = world.add(std::move(spec));
  for (int i = 0; i < 500; ++i) {
    world->step();
    ASSERT_LT(std::abs(model.find_joint("j")->position()), 1.5);
  }
  EXPECT_NEAR(model.find_joint("j")->position(), 0.5, 0.01);
}

TEST(Spring, OneThatPullsBeyondAllBoundsStopsItsBodiesAndNotTheProgram) {
  TestWorld world(weightless(0.01));
  ModelSpec spec = make_on_world(JointType::kRevolute, {0, 0, 0}, {0, 0, 1});
  spec.joints[0].spring_stiffness = 0.2;
  spec.joints[0].spring_reference = -1e308;
  world.add(std::move(spec));
  world->step(10);
  EXPECT_EQ(world.report_count(Severity::kWarning, "grows without bound"), 1u);
}

TEST(Revolute, AnEffortBeyondAllBoundsStopsItsBodiesAndNotTheProgram) {
  for (const double effort : {1e15, -1e15}) {
    TestWorld world(weightless(0.01));
    Model& model = world.add(
        make_on_world(JointType::kRevolute, {0, 0, 0}, {0, 0.6, 0.8}, {1e-9, 2e-9, 1e-9}));
    world->apply_effort({model.find_joint("j"), effort, SimTime{0}, SimTime{-1}});
    world->step(10);
    EXPECT_EQ(world.report_count(Severity::kWarning, "grows without bound"), 1u) << effort;
    EXPECT_THROW(
        world->apply_effort({model.find_joint("j"), 1e3 * effort, SimTime{0}, SimTime{-1}}), Error);
  }
}

TEST(Revolute, AnglesCountTurns) {
  TestWorld world(weightless(0.01));
  Model& model = world.add(make_on_world(JointType::kRevolute, {0, 0, 0}, {0, 0, 1}));
  Joint& joint = *model.find_joint("j");
  joint.set_velocity(-5.0);
  world->step(400);
  EXPECT_NEAR(joint.position(), -20.0, 0.05);
  world->reset();
  EXPECT_DOUBLE_EQ(joint.position(), 0.0);
}

TEST(Revolute, LimitsOfMoreThanATurnHold) {
  TestWorld world(weightless());
  ModelSpec spec = make_on_world(JointType::kRevolute, {0, 0, 0}, {0, 0, 1});
  spec.joints[0].lower = -3.5;
  spec.joints[0].upper = 8.0;
  Model& model = world.add(std::move(spec));
  Joint& joint = *model.find_joint("j");
  for (const double effort : {0.05, -0.05}) {
    world->apply_effort({&joint, effort, {}, {-1}});
    world->step(6000);
    EXPECT_NEAR(joint.position(), effort > 0.0 ? 8.0 : -3.5, 0.01);
    world->clear_efforts(joint);
  }
}

/// A link that moves may be the parent of one that stands.
TEST(Revolute, LimitsHoldWhenTheChildStands) {
  TestWorld world(weightless());
  ModelSpec spec = make_on_world(JointType::kRevolute, {0, 0, 0}, {0, 0, 1});
  spec.links.push_back(make_link("base", 1.0, {1, 1, 1}));
  spec.joints.push_back(make_joint("fix", JointType::kFixed, "world", "base", {}, {0, 0, 1}));
  spec.joints[0].parent = "bob";
  spec.joints[0].child = "base";
  spec.joints[0].lower = -0.3;
  spec.joints[0].upper = 0.6;
  Model& model = world.add(std::move(spec));
  Joint& joint = *model.find_joint("j");
  world->apply_effort({&joint, 0.05, {}, {-1}});
  world->step(3000);
  EXPECT_NEAR(joint.position(), 0.6, 0.01);
  world->clear_efforts(joint);
  world->apply_effort({&joint, -0.05, {}, {-1}});
  world->step(3000);
  EXPECT_NEAR(joint.position(), -0.3, 0.01);
}

}  // namespace
}  // namespace trident::sim
