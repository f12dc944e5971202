// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "test_world.h"

namespace trident::sim {
namespace {

constexpr double kHalfTurn = 3.14159265358979;

/// A 1 kg bob on a weightless rod of 0.5 m, hinged to the world at (0, 0, 2) about y, at `angle`
/// from straight down when the joint stands at zero.
ModelSpec pendulum(double angle) {
  ModelSpec model;
  model.name = "p";
  model.T_world_model = at(0, 0, 2);
  model.links.push_back(make_link("bob", 1.0, Eigen::Vector3d::Constant(1e-4),
                                  at(-0.5 * std::sin(angle), 0, -0.5 * std::cos(angle))));
  model.joints.push_back(make_joint("hinge", JointType::kRevolute, "world", "bob", {}, {0, 1, 0}));
  return model;
}

ModelSpec slider(const Eigen::Vector3d& axis) {
  ModelSpec model;
  model.name = "s";
  model.links.push_back(make_link("cart", 2.0, Eigen::Vector3d::Constant(0.1)));
  model.joints.push_back(make_joint("rail", JointType::kPrismatic, "world", "cart", {}, axis));
  return model;
}

TEST(Revolute, PendulumHasItsPeriod) {
  TestWorld world(world_spec(0.001));
  Model& model = world.add(pendulum(0.05));
  const Joint& hinge = *model.find_joint("hinge");
  std::vector<double> crossings;
  double last = 0.0;
  while (crossings.size() < 5 && world->step_count() < 20000) {
    world->step();
    const double w = hinge.velocity();
    if (last < 0.0 && w >= 0.0) crossings.push_back(world->time().seconds());
    last = w;
  }
  ASSERT_EQ(crossings.size(), 5u);
  const double period = (crossings.back() - crossings.front()) / 4.0;
  const double expected = 2 * kHalfTurn * std::sqrt((0.5 * 0.5 + 1e-4) / (9.8 * 0.5));
  EXPECT_NEAR(period, expected, 0.005 * expected);
}

TEST(Revolute, TheBobStaysOnItsCircle) {
  TestWorld world;
  Model& model = world.add(pendulum(1.0));
  for (int i = 0; i < 500; ++i) {
    world->step();
    const Eigen::Vector3d p = model.links[0]->T_world_link().p;
    ASSERT_NEAR((p - Eigen::Vector3d(0, 0, 2)).norm(), 0.5, 5e-3);
    ASSERT_NEAR(p.y(), 0.0, 1e-9);
  }
}

TEST(Revolute, PositionAndVelocityHaveTheSignOfTheAxis) {
  TestWorld world;
  Model& model = world.add(pendulum(1.0));
  const Joint& hinge = *model.find_joint("hinge");
  EXPECT_DOUBLE_EQ(hinge.position(), 0.0);
  world->step(20);
  // From the -x side the bob swings to +x below the hinge: about -y.
  EXPECT_LT(hinge.velocity(), 0.0);
  EXPECT_LT(hinge.position(), 0.0);
  const double before = hinge.position();
  world->step();
  EXPECT_NEAR((hinge.position() - before) / 0.01, hinge.velocity(), 0.02);
}

TEST(Revolute, LimitsStopIt) {
  TestWorld world;
  ModelSpec spec = pendulum(1.0);
  spec.joints[0].lower = -0.4;
  spec.joints[0].upper = 0.1;
  Model& model = world.add(std::move(spec));
  for (int i = 0; i < 500; ++i) {
    world->step();
    ASSERT_GT(model.find_joint("hinge")->position(), -0.4 - 0.05);
  }
  EXPECT_NEAR(model.find_joint("hinge")->position(), -0.4, 5e-3);
}

TEST(Revolute, DampingTakesEnergyAtItsRate) {
  WorldSpec weightless = world_spec(0.001);
  weightless.physics.gravity.setZero();
  TestWorld space(weightless);
  ModelSpec spec = pendulum(0.0);
  spec.joints[0].damping = 0.1;
  Model& model = space.add(std::move(spec));
  space->set_link_state(*model.links[0], model.links[0]->T_world_link(), {-0.5, 0, 0}, {0, 1, 0});
  space->step(2000);
  const double inertia = 0.25 + 1e-4;
  EXPECT_NEAR(model.find_joint("hinge")->velocity(), std::exp(-0.1 * 2.0 / inertia), 0.005);
}

TEST(Revolute, StrongDampingOfALightLinkIsStable) {
  WorldSpec weightless = world_spec(0.01);
  weightless.physics.gravity.setZero();
  TestWorld world(weightless);
  ModelSpec spec = pendulum(0.0);
  spec.links[0].inertial.mass_kg = 0.001;  // c dt / I = 4
  spec.joints[0].damping = 0.1;
  Model& model = world.add(std::move(spec));
  world->set_link_state(*model.links[0], model.links[0]->T_world_link(), {-0.5, 0, 0}, {0, 1, 0});
  for (int i = 0; i < 100; ++i) {
    world->step();
    ASSERT_LE(std::abs(model.find_joint("hinge")->velocity()), 1.0);
  }
  EXPECT_NEAR(model.find_joint("hinge")->velocity(), 0.0, 1e-3);
}

TEST(Revolute, FrictionHoldsUpToItsTorque) {
  for (const double friction : {1.0, 10.0}) {  // the weight pulls with 4.1 N m
    TestWorld world;
    ModelSpec spec = pendulum(1.0);
    spec.joints[0].friction = friction;
    Model& model = world.add(std::move(spec));
    world->step(100);
    if (friction > 4.2) {
      EXPECT_NEAR(model.find_joint("hinge")->position(), 0.0, 1e-3);
    } else {
      EXPECT_LT(model.find_joint("hinge")->position(), -0.5);
    }
  }
}

TEST(Revolute, BetweenTwoBodiesItKeepsTheirMomentum) {
  WorldSpec weightless = world_spec();
  weightless.physics.gravity.setZero();
  TestWorld world(weightless);
  ModelSpec spec;
  spec.name = "m";
  spec.links.push_back(make_link("a", 1.0, Eigen::Vector3d::Constant(0.1)));
  spec.links.push_back(make_link("b", 2.0, Eigen::Vector3d::Constant(0.1), at(1, 0, 0)));
  spec.joints.push_back(make_joint("j", JointType::kRevolute, "a", "b", at(0.5, 0, 0), {0, 0, 1}));
  Model& model = world.add(std::move(spec));
  ASSERT_EQ(model.bodies.size(), 2u);
  world->apply_effort({model.find_joint("j"), 0.3, {0}, {-1}});
  world->step(50);
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
  for (const auto& body : model.bodies) {
    momentum += body->mass() * body->velocity();
    angular += body->inertia_tensor() * body->angular_velocity() +
               body->pose().p.cross(body->mass() * body->velocity());
  }
  EXPECT_GT(model.find_joint("j")->velocity(), 0.1);
  EXPECT_LT(momentum.norm(), 1e-9);
  EXPECT_LT(angular.norm(), 5e-3);
}

TEST(Prismatic, MovesAlongItsAxisOnly) {
  TestWorld world;
  Model& model = world.add(slider(Eigen::Vector3d(1, 0, -1).normalized()));
  world->step(100);
  const Eigen::Vector3d p = model.links[0]->T_world_link().p;
  const double expected = 0.5 * 9.8 * std::sqrt(0.5) * 1.0 * 1.01;
  EXPECT_NEAR(model.find_joint("rail")->position(), expected, 1e-6);
  EXPECT_NEAR(model.find_joint("rail")->velocity(), 9.8 * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(p.x(), -p.z(), 1e-9);
  EXPECT_NEAR(p.y(), 0.0, 1e-12);
}

TEST(Prismatic, LimitsStopIt) {
  TestWorld world;
  ModelSpec spec = slider({0, 0, 1});
  spec.joints[0].lower = -0.3;
  Model& model = world.add(std::move(spec));
  world->step(300);
  EXPECT_NEAR(model.find_joint("rail")->position(), -0.3, 5e-3);
}

TEST(Prismatic, EffortAcceleratesUpToTheLimitOfTheJoint) {
  for (const double limit : {100.0, 1.0}) {
    TestWorld world;
    ModelSpec spec = slider({1, 0, 0});
    spec.joints[0].effort = limit;
    Model& model = world.add(std::move(spec));
    world->apply_effort({model.find_joint("rail"), 4.0, {0}, {-1}});
    world->step(100);
    EXPECT_NEAR(model.find_joint("rail")->velocity(), std::min(4.0, limit) / 2.0, 1e-6);
  }
}

}  // namespace
}  // namespace trident::sim
