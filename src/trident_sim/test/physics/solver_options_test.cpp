// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Whether what <physics> says reaches the solver.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "models.h"
#include "test_world.h"
#include "trident_sim/sdf_loader.h"

namespace trident::sim {
namespace {

/// How far the balls of a column sink into each other within a second [m].
double sinking(const PhysicsSpec& physics) {
  WorldSpec spec = world_spec();
  spec.physics = physics;
  TestWorld world(spec);
  world.add(make_ground());
  Model* top = nullptr;
  for (int i = 0; i < 6; ++i) {
    top = &world.add(make_body("b" + std::to_string(i), SphereShape{0.1}, at(0, 0, 0.1 + 0.2 * i)));
  }
  world->step(100);
  return 1.1 - top->T_world_model().p.z();
}

PhysicsSpec iterative(int iterations, double sor = 1.3) {
  PhysicsSpec physics = world_spec().physics;
  physics.solver = "quick";
  physics.exact_solver_rows = 0;
  physics.iterations = iterations;
  physics.sor = sor;
  return physics;
}

TEST(Solver, FewIterationsSinkAndManyDoAsTheExactSolver) {
  const double exact = sinking(world_spec().physics);
  EXPECT_LT(exact, 0.01);
  EXPECT_GT(sinking(iterative(2)), 2 * exact);
  EXPECT_NEAR(sinking(iterative(500)), exact, 1e-3);
}

TEST(Solver, OverRelaxationChangesHowFastIterationsConverge) {
  EXPECT_GT(std::abs(sinking(iterative(5, 0.3)) - sinking(iterative(5, 1.3))), 1e-3);
}

TEST(Solver, QuickIsExactForSmallIslandsUnlessConfiguredOtherwise) {
  PhysicsSpec physics = iterative(2);
  physics.exact_solver_rows = 150;
  EXPECT_EQ(sinking(physics), sinking(world_spec().physics));
}

/// Error of a hinge's anchor after a step that began with 0.1 m of it.
double hinge_error_after_a_step(const PhysicsSpec& physics) {
  WorldSpec spec = world_spec();
  spec.physics = physics;
  spec.physics.gravity.setZero();
  TestWorld world(spec);
  ModelSpec model;
  model.name = "m";
  model.links.push_back(make_link("l", 1.0, {1, 1, 1}));
  model.joints.push_back(make_joint("j", JointType::kRevolute, "world", "l", {}, {0, 0, 1}));
  Model& spawned = world.add(std::move(model));
  world->set_link_state(*spawned.links[0], at(0, 0, 0.1), {0, 0, 0}, {0, 0, 0});
  world->step();
  return spawned.links[0]->T_world_link().p.z();
}

TEST(Solver, ErpIsTheFractionOfAnErrorThatAStepTakesBack) {
  for (const double erp : {0.1, 0.2, 0.8}) {
    PhysicsSpec physics = world_spec().physics;
    physics.erp = erp;
    EXPECT_NEAR(hinge_error_after_a_step(physics), 0.1 * (1.0 - erp), 1e-9);
  }
}

TEST(Solver, CfmSoftensConstraints) {
  PhysicsSpec physics = world_spec().physics;
  const double hard = hinge_error_after_a_step(physics);
  physics.cfm = 0.01;  // as much softness as the mass of 1 kg has over a step
  const double soft = hinge_error_after_a_step(physics);
  EXPECT_NEAR(0.1 - soft, 0.5 * (0.1 - hard), 1e-6);
}

TEST(Solver, WorldsMayChangeTheirSolverAndBadValuesChangeNothing) {
  TestWorld world;
  PhysicsSpec physics = world->physics();
  physics.solver = "quick";
  physics.iterations = 77;
  world->set_physics(physics);
  EXPECT_EQ(world->physics().iterations, 77);
  const auto refusal = [&](auto change) {
    PhysicsSpec bad = physics;
    change(bad);
    return error_of([&] { world->set_physics(bad); });
  };
  EXPECT_TRUE(contains(refusal([](PhysicsSpec& p) { p.solver = "best"; }),
                       "physics: solver type is 'best', must be quick or world"));
  EXPECT_TRUE(contains(refusal([](PhysicsSpec& p) { p.iterations = 0; }), "iterations is '0'"));
  EXPECT_TRUE(contains(refusal([](PhysicsSpec& p) { p.sor = 2.0; }), "sor is '2'"));
  EXPECT_TRUE(contains(refusal([](PhysicsSpec& p) { p.erp = 1.5; }), "erp is '1.5'"));
  EXPECT_TRUE(contains(refusal([](PhysicsSpec& p) { p.exact_solver_rows = -1; }),
                       "exact_solver_rows is '-1'"));
  EXPECT_EQ(world->physics().iterations, 77);
  EXPECT_EQ(world->physics().solver, "quick");
}

TEST(Solver, SdfSaysAllOfIt) {
  const WorldSpec world = load_world_string(
      "<sdf version='1.6' xmlns:trident='urn:trident'><world name='w'><physics type='ode'>"
      "<trident:exact_solver_rows>30</trident:exact_solver_rows><max_contacts>12</max_contacts>"
      "<ode><solver><type>world</type><iters>80</iters><precon_iters>3</precon_iters><sor>1.1</sor>"
      "</solver><constraints><cfm>1e-5</cfm><erp>0.4</erp><contact_max_correcting_vel>7"
      "</contact_max_correcting_vel><contact_surface_layer>0.002</contact_surface_layer>"
      "</constraints></ode></physics></world></sdf>",
      "w", Resources(), [](const std::string&) {});
  const PhysicsSpec& physics = world.physics;
  EXPECT_EQ(physics.solver, "world");
  EXPECT_EQ(physics.exact_solver_rows, 30);
  EXPECT_EQ(physics.iterations, 80);
  EXPECT_EQ(physics.precon_iterations, 3);
  EXPECT_DOUBLE_EQ(physics.sor, 1.1);
  EXPECT_DOUBLE_EQ(physics.cfm, 1e-5);
  EXPECT_DOUBLE_EQ(physics.erp, 0.4);
  EXPECT_DOUBLE_EQ(physics.contact_max_correcting_vel, 7.0);
  EXPECT_DOUBLE_EQ(physics.contact_surface_layer, 0.002);
  EXPECT_EQ(physics.max_contacts, 12);
}

}  // namespace
}  // namespace trident::sim
