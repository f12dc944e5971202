// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "core/physics/engine_body.h"
#include "models.h"
#include "test_world.h"

namespace trident::sim {
namespace {

bool near(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, double tolerance) {
  return (a - b).cwiseAbs().maxCoeff() <= tolerance;
}

TEST(Inertia, TwoFixedMassesByHand) {
  // 2 kg at the origin and 1 kg at (3, 0, 0): centre (1, 0, 0), Iyy = Izz = 2*1 + 1*4 + own.
  ModelSpec spec;
  spec.name = "m";
  spec.links.push_back(make_link("a", 2.0, {0.1, 0.2, 0.3}));
  spec.links.push_back(make_link("b", 1.0, {0.01, 0.02, 0.03}, at(3, 0, 0)));
  spec.joints.push_back(make_joint("j", JointType::kFixed, "a", "b", at(3, 0, 0), {0, 0, 1}));
  TestWorld world;
  const Body& body = *world.add(std::move(spec)).bodies.at(0);
  EXPECT_DOUBLE_EQ(body.mass(), 3.0);
  EXPECT_TRUE(is_near(body.pose().p, {1, 0, 0}, 1e-12));
  EXPECT_TRUE(near(body.inertia_tensor(), Eigen::Vector3d(0.11, 6.22, 6.33).asDiagonal(), 1e-12));
  EXPECT_TRUE(near(body.inertia_tensor() * engine_body(body).composite.inertia_inverse,
                   Eigen::Matrix3d::Identity(), 1e-12));
}

TEST(Inertia, ARotatedLinkSwapsItsAxes) {
  ModelSpec spec;
  spec.name = "m";
  spec.links.push_back(make_link("a", 1.0, {1, 1, 1}));
  spec.links.push_back(
      make_link("b", 1.0, {0.1, 0.2, 0.3}, SE3::from_xyz_rpy({0, 0, 0}, 0, 0, std::acos(0.0))));
  spec.joints.push_back(make_joint("j", JointType::kFixed, "a", "b", {}, {0, 0, 1}));
  TestWorld world;
  const Body& body = *world.add(std::move(spec)).bodies.at(0);
  EXPECT_TRUE(near(body.inertia_tensor(), Eigen::Vector3d(1.2, 1.1, 1.3).asDiagonal(), 1e-12));
}

TEST(Inertia, TheInertialFrameCounts) {
  ModelSpec spec = make_body("m", SphereShape{0.1}, at(1, 2, 3));
  spec.links[0].inertial.T_link_com = SE3::from_xyz_rpy({0, 0, 0.5}, std::acos(0.0), 0, 0);
  spec.links[0].inertial.inertia_com = Eigen::Vector3d(0.1, 0.2, 0.3).asDiagonal();
  TestWorld world;
  const Body& body = *world.add(std::move(spec)).bodies.at(0);
  EXPECT_TRUE(is_near(body.pose().p, {1, 2, 3.5}, 1e-12));
  EXPECT_TRUE(near(body.inertia_tensor(), Eigen::Vector3d(0.1, 0.3, 0.2).asDiagonal(), 1e-12));
}

TEST(Inertia, ARotorJointLoadsItsCarrierRoundAndWithoutItsAxis) {
  QuadOptions options;
  TestWorld world;
  Model& quad = world.add(make_quad(options));
  ASSERT_EQ(quad.bodies.size(), 1u);
  const double arm = options.rotor_mass_kg * options.arm_m * options.arm_m;
  const Eigen::Vector3d expected(0.007 + 4 * 1e-5 + 2 * arm, 0.008 + 4 * 1e-5 + 2 * arm,
                                 0.012 + 4 * arm);
  EXPECT_TRUE(near(quad.bodies[0]->inertia_tensor(), expected.asDiagonal(), 1e-12));
  EXPECT_DOUBLE_EQ(quad.find_joint("rotor_0_joint")->rotor_inertia.axial, 2e-5);
}

TEST(Inertia, ChainsOfFixedJointsInAnyOrderAreOneBody) {
  ModelSpec spec;
  spec.name = "m";
  for (const char* name : {"c", "a", "b", "d"})
    spec.links.push_back(make_link(name, 1.0, {1, 1, 1}));
  spec.joints.push_back(make_joint("j1", JointType::kFixed, "a", "b", {}, {0, 0, 1}));
  spec.joints.push_back(make_joint("j2", JointType::kFixed, "c", "d", {}, {0, 0, 1}));
  spec.joints.push_back(make_joint("j3", JointType::kFixed, "b", "c", {}, {0, 0, 1}));
  TestWorld world;
  const Model& model = world.add(std::move(spec));
  ASSERT_EQ(model.bodies.size(), 1u);
  EXPECT_DOUBLE_EQ(model.bodies[0]->mass(), 4.0);
  EXPECT_EQ(model.bodies[0]->scoped_name(), "m::c");
}

TEST(Inertia, WhatIsFixedToTheWorldDoesNotMove) {
  ModelSpec spec = make_body("m", SphereShape{0.1}, at(0, 0, 5));
  spec.joints.push_back(make_joint("j", JointType::kFixed, "world", "link", {}, {0, 0, 1}));
  TestWorld world;
  Model& model = world.add(std::move(spec));
  EXPECT_TRUE(model.bodies.empty());
  world->step(10);
  EXPECT_TRUE(is_near(model.T_world_model(), at(0, 0, 5), 0.0));
}

}  // namespace
}  // namespace trident::sim
