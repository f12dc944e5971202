// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "quad_world.h"

namespace trident::sim {
namespace {

TEST(SetState, AModelIsPutWhereAsked) {
  QuadWorld quad;
  const SE3 target = SE3::from_xyz_rpy({1, 2, 3}, 0.1, 0.2, 0.3);
  quad->set_model_pose(*quad.quad, target);
  EXPECT_TRUE(is_near(quad.quad->T_world_model(), target, 1e-12));
  EXPECT_TRUE(is_near(quad.quad->find_link("rotor_0")->T_world_link().p,
                      target * Eigen::Vector3d(0.25, 0, 0), 1e-12));
}

TEST(SetState, ATwistIsThatOfTheModelOrigin) {
  TestWorld world;
  ModelSpec spec = make_body("m", SphereShape{0.1}, {});
  spec.links[0].inertial.T_link_com.p = {1, 0, 0};
  Model& model = world.add(std::move(spec));
  world->set_model_twist(model, {1, 0, 0}, {0, 0, 2});
  EXPECT_TRUE(is_near(model.bodies[0]->velocity(), {1, 2, 0}, 1e-12));
  EXPECT_TRUE(is_near(model.canonical_link()->v_world_at({0, 0, 0}), {1, 0, 0}, 1e-12));
}

TEST(SetState, APoseTurnsTheVelocityWithTheModel) {
  TestWorld world;
  Model& model = world.add(make_body("m", SphereShape{0.1}, {}));
  world->set_model_twist(model, {1, 0, 0}, {0, 0, 0});
  world->set_model_pose(model, SE3::from_xyz_rpy({0, 0, 0}, 0, 0, std::acos(0.0)));
  EXPECT_TRUE(is_near(model.bodies[0]->velocity(), {0, 1, 0}, 1e-12));
}

TEST(SetState, JointsKeepTheirAnglesWhenAModelMoves) {
  TestWorld world;
  ModelSpec spec;
  spec.name = "m";
  spec.links.push_back(make_link("a", 1.0, {1, 1, 1}));
  spec.links.push_back(make_link("b", 1.0, {1, 1, 1}, at(1, 0, 0)));
  spec.joints.push_back(make_joint("j", JointType::kRevolute, "a", "b", at(0.5, 0, 0), {0, 0, 1}));
  Model& model = world.add(std::move(spec));
  world->apply_effort({model.find_joint("j"), 1.0, {0}, {-1}});
  world->step(50);
  const double angle = model.find_joint("j")->position();
  EXPECT_GT(std::abs(angle), 0.05);
  world->set_model_pose(model, SE3::from_xyz_rpy({5, 6, 7}, 0.4, 0.5, 0.6));
  EXPECT_NEAR(model.find_joint("j")->position(), angle, 1e-9);
  world->step();
  EXPECT_NEAR(model.find_joint("j")->position(), angle, 0.02);
}

TEST(SetState, ALinkIsPutWhereAskedAndItsJointFollowsAtOnce) {
  TestWorld world;
  ModelSpec spec;
  spec.name = "m";
  spec.links.push_back(make_link("wheel", 1.0, {1, 1, 1}));
  spec.joints.push_back(make_joint("j", JointType::kRevolute, "world", "wheel", {}, {0, 0, 1}));
  Model& model = world.add(std::move(spec));
  world->set_link_state(*model.links[0], SE3::from_xyz_rpy({0, 0, 0}, 0, 0, 0.7), {0, 0, 0},
                        {0, 0, 3});
  EXPECT_NEAR(model.find_joint("j")->position(), 0.7, 1e-9);
  EXPECT_NEAR(model.find_joint("j")->velocity(), 3.0, 1e-9);
}

TEST(SetState, NonsenseIsRefusedAndChangesNothing) {
  TestWorld world;
  Model& model = world.add(make_body("m", SphereShape{0.1}, at(1, 2, 3)));
  Model& fixed = world.add(make_static("s", SphereShape{0.1}, at(0, 0, 0)));
  const std::string before = world->state_hash();
  const double nan = std::nan("");
  const SE3 no_rotation{Eigen::Quaterniond(0, 0, 0, 0), {0, 0, 0}};
  EXPECT_TRUE(contains(error_of([&] { world->set_model_pose(model, at(nan, 0, 0)); }), "'m'"));
  EXPECT_TRUE(contains(error_of([&] { world->set_model_pose(model, no_rotation); }), "quaternion"));
  EXPECT_TRUE(contains(error_of([&] { world->set_model_pose(fixed, at(1, 0, 0)); }), "static"));
  EXPECT_TRUE(contains(error_of([&] {
                         world->set_model_twist(model, {nan, 0, 0}, {0, 0, 0});
                       }),
                       "'m'"));
  EXPECT_TRUE(contains(error_of([&] {
                         world->set_link_state(*fixed.links[0], {}, {0, 0, 0}, {0, 0, 0});
                       }),
                       "static"));
  EXPECT_EQ(world->state_hash(), before);
}

TEST(Wrench, ActsFromItsStartForItsDuration) {
  TestWorld world;
  ModelSpec spec = make_body("m", SphereShape{0.1}, {}, 2.0);
  spec.links[0].gravity = false;
  Model& model = world.add(std::move(spec));
  world->apply_wrench({model.canonical_link(),
                       {6, 0, 0},
                       {0, 0, 0},
                       {0, 0, 0},
                       SimTime::from_seconds(0.05),
                       SimTime::from_seconds(0.1)});
  world->step(5);
  EXPECT_EQ(model.bodies[0]->velocity().x(), 0.0);
  world->step(100);
  EXPECT_NEAR(model.bodies[0]->velocity().x(), 6.0 / 2.0 * 0.1, 1e-12);
}

TEST(Wrench, WithoutEndActsUntilCleared) {
  TestWorld world;
  ModelSpec spec = make_body("m", SphereShape{0.1}, {});
  spec.links[0].gravity = false;
  Model& model = world.add(std::move(spec));
  world->apply_wrench({model.canonical_link(), {1, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0}, {-1}});
  world->step(30);
  world->clear_wrenches(*model.canonical_link());
  world->step(30);
  EXPECT_NEAR(model.bodies[0]->velocity().x(), 0.3, 1e-12);
}

TEST(Wrench, OffTheCenterItTurns) {
  TestWorld world;
  ModelSpec spec = make_body("m", SphereShape{0.1}, {});
  spec.links[0].gravity = false;
  Model& model = world.add(std::move(spec));
  world->apply_wrench({model.canonical_link(), {0, 1, 0}, {0, 0, 0.5}, {0.2, 0, 0}, {0}, {-1}});
  world->step();
  EXPECT_NEAR(model.bodies[0]->angular_velocity().z(),
              (0.2 + 0.5) / model.bodies[0]->inertia_tensor()(2, 2) * 0.01, 1e-9);
}

TEST(Wrench, NonsenseIsRefused) {
  TestWorld world;
  Model& model = world.add(make_body("m", SphereShape{0.1}, {}));
  Model& fixed = world.add(make_static("s", SphereShape{0.1}, at(5, 0, 0)));
  EXPECT_TRUE(contains(
      error_of([&] {
        world->apply_wrench(
            {model.canonical_link(), {std::nan(""), 0, 0}, {0, 0, 0}, {0, 0, 0}, {0}, {-1}});
      }),
      "not finite"));
  EXPECT_TRUE(contains(
      error_of([&] {
        world->apply_wrench({fixed.canonical_link(), {1, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0}, {-1}});
      }),
      "static"));
}

TEST(Physics, BadValuesAreRefusedWithFieldAndRangeAndChangeNothing) {
  TestWorld world;
  const PhysicsSpec good = world->physics();
  struct Bad {
    const char* field;
    void (*spoil)(PhysicsSpec&);
  };
  const Bad cases[] = {
      {"max_step_size", [](PhysicsSpec& p) { p.max_step_size_s = 0.0; }},
      {"max_step_size", [](PhysicsSpec& p) { p.max_step_size_s = std::nan(""); }},
      {"gravity", [](PhysicsSpec& p) { p.gravity.x() = INFINITY; }},
      {"iterations", [](PhysicsSpec& p) { p.iterations = 0; }},
      {"sor", [](PhysicsSpec& p) { p.sor = 2.5; }},
      {"cfm", [](PhysicsSpec& p) { p.cfm = -1.0; }},
      {"erp", [](PhysicsSpec& p) { p.erp = 1.5; }},
      {"contact_surface_layer", [](PhysicsSpec& p) { p.contact_surface_layer = -0.1; }},
      {"contact_max_correcting_vel", [](PhysicsSpec& p) { p.contact_max_correcting_vel = -1.0; }},
      {"max_contacts", [](PhysicsSpec& p) { p.max_contacts = 0; }},
      {"real_time_update_rate", [](PhysicsSpec& p) { p.real_time_update_rate_hz = -1.0; }}};
  for (const Bad& bad : cases) {
    PhysicsSpec spec = good;
    bad.spoil(spec);
    const std::string error = error_of([&] { world->set_physics(spec); });
    EXPECT_TRUE(contains(error, bad.field));
    EXPECT_TRUE(contains(error, "must be"));
  }
  EXPECT_EQ(world->physics().max_step_size_s, good.max_step_size_s);
}

TEST(Physics, StepAndGravityChangeAtRunTime) {
  TestWorld world;
  Model& model = world.add(make_body("m", SphereShape{0.1}, {}));
  world->step(10);
  PhysicsSpec physics = world->physics();
  physics.max_step_size_s = 0.002;
  physics.gravity = {0, 0, -1};
  world->set_physics(physics);
  const double before = model.bodies[0]->velocity().z();
  world->step(10);
  EXPECT_EQ(world->time(), SimTime::from_seconds(0.12));
  EXPECT_NEAR(model.bodies[0]->velocity().z() - before, -0.02, 1e-12);
}

}  // namespace
}  // namespace trident::sim
