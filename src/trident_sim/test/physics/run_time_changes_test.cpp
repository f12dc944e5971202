// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Properties that are set at run time: links, joints, positions of joints.
#include <gtest/gtest.h>

#include <cmath>

#include "quad_world.h"

namespace trident::sim {
namespace {

Inertial some_inertial() {
  Inertial inertial;
  inertial.mass_kg = 2.5;
  inertial.T_link_com = SE3::from_xyz_rpy({0.1, -0.05, 0.2}, 0.3, 0.0, 0.1);
  inertial.inertia_com = Eigen::Vector3d(0.04, 0.05, 0.06).asDiagonal();
  return inertial;
}

/// base - fixed - mast, base - shoulder (z) - arm - elbow (y) - hand.
ModelSpec robot() {
  ModelSpec model;
  model.name = "r";
  model.T_world_model = SE3::from_xyz_rpy({1, 2, 3}, 0.1, 0.2, 0.3);
  model.links.push_back(make_link("base", 1.0, {0.1, 0.1, 0.1}));
  model.links.push_back(make_link("mast", 0.5, {0.02, 0.03, 0.04}, at(0, 0, 0.5)));
  model.links.push_back(make_link("arm", 0.3, {0.01, 0.01, 0.01}, at(0.4, 0, 0)));
  model.links.push_back(make_link("hand", 0.1, {0.01, 0.02, 0.01}, at(0.8, 0, 0)));
  model.joints.push_back(make_joint("weld", JointType::kFixed, "base", "mast", {}, {0, 0, 1}));
  model.joints.push_back(
      make_joint("shoulder", JointType::kRevolute, "base", "arm", at(0.2, 0, 0), {0, 0, 1}));
  model.joints.push_back(
      make_joint("elbow", JointType::kRevolute, "arm", "hand", at(0.6, 0, 0), {0, 1, 0}));
  return model;
}

void expect_same_links(const Model& a, const Model& b, double tolerance) {
  for (std::size_t i = 0; i < a.links.size(); ++i) {
    const SE3 T = a.links[i]->T_world_link();
    EXPECT_TRUE(is_near(T, b.links[i]->T_world_link(), tolerance)) << a.links[i]->name;
    EXPECT_TRUE(is_near(a.links[i]->v_world_at(T.p), b.links[i]->v_world_at(T.p), tolerance));
    EXPECT_TRUE(is_near(a.links[i]->w_world(), b.links[i]->w_world(), tolerance));
  }
}

class LinkInertial : public testing::TestWithParam<const char*> {};

TEST_P(LinkInertial, SetOrSpawnedWithGivesTheSameMotion) {
  TestWorld set, spawned;
  Model& model = set.add(robot());
  set->set_link_inertial(*model.find_link(GetParam()), some_inertial(), true);
  ModelSpec spec = robot();
  for (LinkSpec& link : spec.links) {
    if (link.name == GetParam()) link.inertial = some_inertial();
  }
  Model& expected = spawned.add(std::move(spec));
  for (TestWorld* world : {&set, &spawned}) {
    Model& own = *(*world)->find_model("r");
    (*world)->apply_effort({own.find_joint("shoulder"), 0.2, {0}, {-1}});
    (*world)->apply_wrench({own.find_link("mast"), {1, 2, 30}, {0.1, 0, 0}, {0, 0, 0}, {0}, {-1}});
    (*world)->step(50);
  }
  expect_same_links(model, expected, 1e-9);
  EXPECT_NEAR(model.find_joint("shoulder")->position(), expected.find_joint("shoulder")->position(),
              1e-9);
}

TEST_P(LinkInertial, SetInMotionLeavesTheMotionAsItIs) {
  TestWorld world;
  Model& model = world.add(robot());
  world->apply_effort({model.find_joint("shoulder"), 0.2, {0}, {-1}});
  world->step(40);
  const Joint& elbow = *model.find_joint("elbow");
  const Link& hand = *model.find_link("hand");
  const SE3 T = hand.T_world_link();
  const Eigen::Vector3d v = hand.v_world_at(T.p), w = hand.w_world();
  const double angle = elbow.position(), rate = elbow.velocity();
  world->set_link_inertial(*model.find_link(GetParam()), some_inertial(), true);
  EXPECT_TRUE(is_near(hand.T_world_link(), T, 1e-12));
  EXPECT_TRUE(is_near(hand.v_world_at(T.p), v, 1e-12));
  EXPECT_TRUE(is_near(hand.w_world(), w, 1e-12));
  EXPECT_NEAR(elbow.position(), angle, 1e-12);
  EXPECT_NEAR(elbow.velocity(), rate, 1e-12);
  world->step(100);
  EXPECT_NEAR((hand.T_world_link() * Eigen::Vector3d(-0.2, 0, 0) -
               model.find_link("arm")->T_world_link() * Eigen::Vector3d(0.2, 0, 0))
                  .norm(),
              0.0, 5e-3);  // the elbow holds
}

TEST_P(LinkInertial, AResetGoesBackToTheSpawnedPose) {
  TestWorld world;
  Model& model = world.add(robot());
  const SE3 T = model.find_link("hand")->T_world_link();
  world->set_link_inertial(*model.find_link(GetParam()), some_inertial(), true);
  world->step(30);
  world->reset_models();
  EXPECT_TRUE(is_near(model.find_link("hand")->T_world_link(), T, 1e-12));
  EXPECT_NEAR(model.find_joint("elbow")->position(), 0.0, 1e-12);
}
INSTANTIATE_TEST_SUITE_P(Links, LinkInertial, testing::Values("base", "mast", "arm", "hand"));

TEST(LinkInertial, AFlyingQuadFeelsIt) {
  const QuadOptions heavy = [] {
    QuadOptions options;
    options.body_mass_kg = 1.7;
    return options;
  }();
  QuadWorld set, spawned(heavy);
  Link& base = *set.quad->find_link("base_link");
  Inertial inertial = base.inertial;
  inertial.mass_kg = heavy.body_mass_kg;
  set->set_link_inertial(base, inertial, true);
  for (QuadWorld* world : {&set, &spawned}) {
    world->command_all(700.0);
    (*world)->step(100);
  }
  expect_same_links(*set.quad, *spawned.quad, 1e-9);
}

TEST(LinkInertial, ARotorsLeverFollowsTheCenterOfMass) {
  QuadWorld set;
  Link& base = *set.quad->find_link("base_link");
  Inertial inertial = base.inertial;
  inertial.T_link_com.p.x() = 0.05;  // the front rotor's lever is shorter: the quad pitches
  set->set_link_inertial(base, inertial, true);
  set.command_all(700.0);
  set->step(30);
  EXPECT_GT(set.quad->bodies[0]->angular_velocity().y(), 0.1);
}

TEST(LinkInertial, GravityIsALinksOwn) {
  TestWorld world;
  ModelSpec spec = robot();
  spec.joints.resize(1);  // base and mast, welded; the others fly on their own
  spec.T_world_model = {};
  Model& model = world.add(std::move(spec));
  Link& mast = *model.find_link("mast");
  world->set_link_inertial(mast, mast.inertial, false);
  Link& arm = *model.find_link("arm");
  world->set_link_inertial(arm, arm.inertial, false);
  world->step(1);
  EXPECT_NEAR(model.find_link("base")->body->velocity().z(), -9.8 * 0.01 * 1.0 / 1.5, 1e-12);
  EXPECT_EQ(arm.body->velocity().z(), 0.0);
  EXPECT_NEAR(model.find_link("hand")->body->velocity().z(), -9.8 * 0.01, 1e-12);
}

TEST(LinkInertial, WeightOffTheCenterOfMassTurns) {
  TestWorld world;
  ModelSpec spec;
  spec.name = "dumbbell";
  spec.links.push_back(make_link("a", 1.0, {0.1, 0.1, 0.1}));
  spec.links.push_back(make_link("b", 1.0, {0.1, 0.1, 0.1}, at(1, 0, 0)));
  spec.links[1].gravity = false;
  spec.joints.push_back(make_joint("weld", JointType::kFixed, "a", "b", {}, {0, 0, 1}));
  Model& model = world.add(std::move(spec));
  world->step(1);
  // 1 kg pulls 0.5 m from the centre of 2 kg whose inertia is 0.2 + 2 * 0.25.
  EXPECT_NEAR(model.bodies[0]->velocity().z(), -9.8 / 2.0 * 0.01, 1e-12);
  EXPECT_NEAR(model.bodies[0]->angular_velocity().y(), -9.8 * 0.5 / 0.7 * 0.01, 1e-9);
}

TEST(LinkInertial, AnOlderSnapshotFitsNoMore) {
  TestWorld world;
  Model& model = world.add(robot());
  const Snapshot before = world->save_snapshot();
  world->set_link_inertial(*model.find_link("arm"), some_inertial(), true);
  EXPECT_TRUE(contains(error_of([&] { world->restore_snapshot(before); }), "does not fit"));
  const Snapshot after = world->save_snapshot();
  world->step(10);
  const std::string hash = world->state_hash();
  world->restore_snapshot(after);
  world->step(10);
  EXPECT_EQ(world->state_hash(), hash);
}

TEST(LinkInertial, NonsenseIsRefusedAndChangesNothing) {
  TestWorld world;
  Model& model = world.add(robot());
  Link& arm = *model.find_link("arm");
  const std::string before = world->state_hash();
  Inertial inertial = some_inertial();
  inertial.mass_kg = 0.0;
  EXPECT_TRUE(
      contains(error_of([&] { world->set_link_inertial(arm, inertial, true); }), "(0, 1e12]"));
  inertial = some_inertial();
  inertial.inertia_com(0, 1) = inertial.inertia_com(1, 0) = 1.0;
  EXPECT_TRUE(contains(error_of([&] { world->set_link_inertial(arm, inertial, true); }),
                       "principal inertia"));
  inertial = some_inertial();
  inertial.T_link_com.p.z() = std::nan("");
  EXPECT_TRUE(contains(error_of([&] { world->set_link_inertial(arm, inertial, true); }), "com"));
  EXPECT_EQ(world->state_hash(), before);
  EXPECT_EQ(arm.inertial.mass_kg, 0.3);
}

/// A flywheel that turns about the world's z, without gravity.
class Wheel : public testing::Test {
 protected:
  Wheel() : world_(weightless()) {
    ModelSpec spec;
    spec.name = "w";
    spec.links.push_back(make_link("wheel", 1.0, {0.1, 0.1, 0.1}));
    spec.joints.push_back(make_joint("j", JointType::kRevolute, "world", "wheel", {}, {0, 0, 1}));
    model_ = &world_.add(std::move(spec));
    joint_ = model_->find_joint("j");
  }
  static WorldSpec weightless() {
    WorldSpec spec = world_spec(0.01);
    spec.physics.gravity.setZero();
    return spec;
  }
  void set(const AxisParams& params) { world_->set_axis_params(*joint_, 0, params); }

  TestWorld world_;
  Model* model_;
  Joint* joint_;
};

TEST_F(Wheel, DampingActsFromTheNextStep) {
  joint_->set_velocity(1.0);
  AxisParams params;
  params.damping = 0.05;
  set(params);
  world_->step(100);
  EXPECT_NEAR(joint_->velocity(), std::exp(-0.05 / 0.1), 0.01);
}

TEST_F(Wheel, AMotorDrivesUpToItsEffort) {
  AxisParams params;
  params.motor_velocity = 2.0;
  params.motor_effort = 0.1;  // 1 rad/s^2
  set(params);
  world_->step(100);
  EXPECT_NEAR(joint_->velocity(), 1.0, 0.02);
  world_->step(200);
  EXPECT_NEAR(joint_->velocity(), 2.0, 1e-6);
  params = {};
  params.motor_effort = 0.0;
  set(params);
  joint_->set_velocity(0.5);
  world_->step(10);
  EXPECT_NEAR(joint_->velocity(), 0.5, 1e-9);
}

TEST_F(Wheel, LimitsComeAndGo) {
  AxisParams params;
  params.lower = -0.5;
  params.upper = 0.25;
  set(params);
  world_->apply_effort({joint_, 0.05, {0}, {-1}});
  world_->step(400);
  EXPECT_NEAR(joint_->position(), 0.25, 0.01);
  params.lower = -1e9;
  params.upper = 5.0;  // more than a turn's half: counted
  set(params);
  world_->step(1500);
  EXPECT_NEAR(joint_->position(), 5.0, 0.02);
}

TEST_F(Wheel, BadValuesAreRefusedWholly) {
  AxisParams params;
  params.damping = 0.5;
  params.lower = 1.0;
  params.upper = -1.0;
  EXPECT_TRUE(contains(error_of([&] { set(params); }), "hiStop"));
  EXPECT_EQ(joint_->axes[0].damping, 0.0);
  params = {};
  params.damping = -1.0;
  EXPECT_TRUE(contains(error_of([&] { set(params); }), "damping is -1"));
  params = {};
  params.fudge_factor = 2.0;
  EXPECT_TRUE(contains(error_of([&] { set(params); }), "fudge_factor"));
  EXPECT_TRUE(contains(error_of([&] { world_->set_axis_params(*joint_, 1, {}); }), "1 axes"));
}

TEST(AxisParams, ARotorHasNone) {
  QuadWorld quad;
  AxisParams params;
  params.damping = 0.1;
  EXPECT_TRUE(contains(
      error_of([&] { quad->set_axis_params(*quad.quad->find_joint("rotor_0_joint"), 0, params); }),
      "rotor"));
}

TEST(JointPositions, WhatHangsOnAJointMovesAlong) {
  TestWorld world;
  Model& model = world.add(robot());
  const SE3 T_base = model.find_link("base")->T_world_link();
  EXPECT_TRUE(world->set_joint_positions(model, {{"shoulder", 0.7}, {"elbow", -0.4}}).empty());
  EXPECT_NEAR(model.find_joint("shoulder")->position(), 0.7, 1e-12);
  EXPECT_NEAR(model.find_joint("elbow")->position(), -0.4, 1e-12);
  EXPECT_TRUE(is_near(model.find_link("base")->T_world_link(), T_base, 0.0));
  const SE3 expected = T_base * at(0.2, 0, 0) * SE3::from_xyz_rpy({0, 0, 0}, 0, 0, 0.7) *
                       at(0.4, 0, 0) * SE3::from_xyz_rpy({0, 0, 0}, 0, -0.4, 0) * at(0.2, 0, 0);
  EXPECT_TRUE(is_near(model.find_link("hand")->T_world_link(), expected, 1e-12));
  world->step(1);
  EXPECT_NEAR(model.find_joint("elbow")->position(), -0.4, 0.01);
}

TEST(JointPositions, TheMotionOfTheJointStays) {
  TestWorld world;
  Model& model = world.add(robot());
  world->apply_effort({model.find_joint("shoulder"), 0.2, {0}, {-1}});
  world->apply_effort({model.find_joint("elbow"), 0.02, {0}, {-1}});
  world->step(30);
  const double shoulder = model.find_joint("shoulder")->velocity();
  const double elbow = model.find_joint("elbow")->velocity();
  world->set_joint_positions(model, {{"shoulder", -1.0}, {"elbow", 1.0}});
  EXPECT_NEAR(model.find_joint("shoulder")->velocity(), shoulder, 1e-12);
  EXPECT_NEAR(model.find_joint("elbow")->velocity(), elbow, 1e-12);
}

TEST(JointPositions, LimitsHoldAndTurnsAreCounted) {
  TestWorld world;
  ModelSpec spec = robot();
  spec.joints[1].lower = -0.5;
  spec.joints[1].upper = 0.5;
  Model& model = world.add(std::move(spec));
  EXPECT_EQ(world->set_joint_positions(model, {{"shoulder", 2.0}, {"elbow", 9.0}}),
            std::vector<std::string>{"shoulder"});
  EXPECT_NEAR(model.find_joint("shoulder")->position(), 0.5, 1e-12);
  EXPECT_NEAR(model.find_joint("elbow")->position(), 9.0, 1e-12);
  world->step(1);
  EXPECT_NEAR(model.find_joint("elbow")->position(), 9.0, 0.01);
}

TEST(JointPositions, PrismaticAndRotorJointsHaveThemToo) {
  TestWorld world;
  ModelSpec spec;
  spec.name = "lift";
  spec.links.push_back(make_link("cart", 2.0, {0.1, 0.1, 0.1}));
  spec.joints.push_back(make_joint("rail", JointType::kPrismatic, "world", "cart", {}, {0, 0, 1}));
  Model& model = world.add(std::move(spec));
  world->set_joint_positions(model, {{"rail", 1.5}});
  EXPECT_NEAR(model.find_joint("rail")->position(), 1.5, 1e-12);
  EXPECT_TRUE(is_near(model.links[0]->T_world_link().p, {0, 0, 1.5}, 1e-12));
  QuadWorld quad;
  quad->set_joint_positions(*quad.quad, {{"rotor_1_joint", 0.3}});
  EXPECT_EQ(quad.quad->find_joint("rotor_1_joint")->position(), 0.3);
}

TEST(JointPositions, WhatCannotBeMovedIsRefusedBeforeAnythingMoves) {
  TestWorld world;
  ModelSpec spec = robot();
  spec.joints.push_back(
      make_joint("latch", JointType::kBall, "base", "hand", at(0.9, 0, 0), {0, 0, 1}));
  Model& model = world.add(std::move(spec));
  const std::string before = world->state_hash();
  const auto refusal = [&](const std::string& joint, double position) {
    return error_of([&] { world->set_joint_positions(model, {{joint, position}}); });
  };
  EXPECT_TRUE(contains(refusal("nothing", 0.1), "[nothing]"));
  EXPECT_TRUE(contains(refusal("weld", 0.1), "fixed"));
  EXPECT_TRUE(contains(refusal("shoulder", std::nan("")), "finite"));
  EXPECT_TRUE(contains(refusal("shoulder", 0.1), "closed loop"));
  EXPECT_EQ(world->state_hash(), before);
}

}  // namespace
}  // namespace trident::sim
