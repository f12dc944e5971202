// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "test_world.h"

namespace trident::sim {
namespace {

constexpr double kDt = 0.01, kRadius = 0.5;
/// Deeper than what a body that was put into another one is moved out of it in a step [m/s].
constexpr double kDepenetrationSpeed = 0.5, kShallow = 0.8 * kDepenetrationSpeed * kDt;
/// Softness of a contact: what a newton takes from the speed of being pushed out [m/s].
constexpr double kSoftness = 1e-8;

Surface with_max_vel(double max_vel_m_s) {
  Surface surface;
  surface.max_vel_m_s = max_vel_m_s;
  return surface;
}
Surface with_min_depth(double min_depth_m) {
  Surface surface;
  surface.min_depth_m = min_depth_m;
  return surface;
}
WorldSpec spec_with(const char* solver, double layer_m = 0.001, double max_vel_m_s = 100.0) {
  WorldSpec spec = world_spec(kDt);
  spec.physics.solver = solver;
  spec.physics.exact_solver_rows = 0;  // with "quick" everything is iterated
  spec.physics.iterations = 100;
  spec.physics.contact_surface_layer = layer_m;
  spec.physics.contact_max_correcting_vel = max_vel_m_s;
  return spec;
}

/// A ball put into the ground.
struct SunkenBall {
  explicit SunkenBall(double depth_m, const Surface& surface = {}, const Surface& of_ground = {},
                      const WorldSpec& spec = world_spec(kDt))
      : world(spec) {
    world.add(make_ground(of_ground));
    ball =
        &world.add(make_body("m", SphereShape{kRadius}, at(0, 0, kRadius - depth_m), 1.0, surface));
  }
  double depth() const { return kRadius - ball->T_world_model().p.z(); }
  double depth_at_rest() {
    world->step(1000);
    EXPECT_LT(ball->bodies[0]->velocity().norm(), 1e-4);
    return depth();
  }
  double speed_after_one_step() {
    world->step();
    return ball->bodies[0]->velocity().z();
  }
  TestWorld world;
  Model* ball;
};

class MinDepth : public testing::TestWithParam<double> {};

TEST_P(MinDepth, IsWhereABodyComesToRest) {
  EXPECT_NEAR(SunkenBall(0.1, with_min_depth(GetParam())).depth_at_rest(), GetParam(), 1e-5);
}
INSTANTIATE_TEST_SUITE_P(Depths, MinDepth, testing::Values(0.0, 0.0005, 0.001, 0.004, 0.05));

TEST(MinDepth, IsNoneByDefaultWhateverTheWorldsLayer) {
  EXPECT_NEAR(SunkenBall(0.1).depth_at_rest(), 0.0, 1e-6);
  EXPECT_NEAR(SunkenBall(0.1, {}, {}, spec_with("world", 0.02)).depth_at_rest(), 0.0, 1e-6);
}

TEST(MinDepth, NothingShallowerIsPushedOut) {
  const double sinks = kSoftness * 9.8 * 1000 * kDt;
  EXPECT_NEAR(SunkenBall(0.1, with_min_depth(0.3)).depth_at_rest(), 0.1 + sinks, 1e-5);
}

/// The depth is put right within a step whatever speed may remain, by each solver.
class MaxVel : public testing::TestWithParam<const char*> {};

TEST_P(MaxVel, IsTheSpeedThatRemainsOfPuttingADepthRight) {
  for (const double max_vel : {0.0, 0.01, 0.3}) {
    SunkenBall sunken(kShallow, with_max_vel(max_vel), {}, spec_with(GetParam()));
    const double force_n = max_vel / kDt + 9.8;
    EXPECT_NEAR(sunken.speed_after_one_step(), max_vel - kSoftness * force_n, 1e-6);
    EXPECT_NEAR(sunken.depth(), 0.0, 1e-6) << max_vel;
  }
}

TEST_P(MaxVel, IsACentimeterASecondByDefault) {
  SunkenBall sunken(kShallow, {}, {}, spec_with(GetParam()));
  EXPECT_NEAR(sunken.speed_after_one_step(), 0.01, 1e-6);
}

TEST_P(MaxVel, IsTheWorldsAtMost) {
  const WorldSpec spec = spec_with(GetParam(), 0.001, 0.05);
  EXPECT_NEAR(SunkenBall(kShallow, with_max_vel(0.3), {}, spec).speed_after_one_step(), 0.05, 1e-6);
  EXPECT_NEAR(SunkenBall(kShallow, with_max_vel(0.02), {}, spec).speed_after_one_step(), 0.02,
              1e-6);
}

TEST_P(MaxVel, DoesNotBoundABounce) {
  Surface bouncy = with_max_vel(0.01);
  bouncy.restitution = 0.5;
  bouncy.bounce_threshold_m_s = 0.01;
  SunkenBall ball(0.001, bouncy, bouncy, spec_with(GetParam()));
  ball.world->set_model_twist(*ball.ball, {0, 0, -2}, {0, 0, 0});
  EXPECT_NEAR(ball.speed_after_one_step(), 1.0, 1e-3);
}

TEST_P(MaxVel, WhatWasPutDeepIntoSomethingComesOutSlowly) {
  SunkenBall sunken(0.1, {}, {}, spec_with(GetParam()));
  double depth = 0.1;
  while (depth > kDepenetrationSpeed * kDt) {
    EXPECT_NEAR(sunken.speed_after_one_step(), 0.01, 1e-5);
    depth -= kDepenetrationSpeed * kDt;
    ASSERT_NEAR(sunken.depth(), depth, 1e-5);
  }
  EXPECT_NEAR(sunken.depth_at_rest(), 0.0, 1e-5);
}
INSTANTIATE_TEST_SUITE_P(Solvers, MaxVel, testing::Values("world", "quick"));

TEST(Correction, AStaticSurfaceHasNoSay) {
  Surface ground = with_max_vel(0.0);
  ground.min_depth_m = 0.05;
  SunkenBall plain(0.1), on_ground(0.1, {}, ground);
  EXPECT_EQ(plain.speed_after_one_step(), on_ground.speed_after_one_step());
  EXPECT_NEAR(on_ground.depth_at_rest(), 0.0, 1e-5);
}

/// Overlap [m] of two free balls, put 0.1 m into each other, after a while.
double overlap_at_rest(const Surface& a, const Surface& b) {
  WorldSpec spec = world_spec(kDt);
  spec.physics.gravity.setZero();
  TestWorld world(spec);
  Model& first = world.add(make_body("a", SphereShape{kRadius}, at(0, 0, 0), 1.0, a));
  Model& second = world.add(make_body("b", SphereShape{kRadius}, at(0.9, 0, 0), 1.0, b));
  for (int i = 0; i < 1000; ++i) {
    world->set_model_twist(first, {0, 0, 0}, {0, 0, 0});  // or they drift apart for good
    world->set_model_twist(second, {0, 0, 0}, {0, 0, 0});
    world->step();
  }
  return 2 * kRadius - (second.T_world_model().p - first.T_world_model().p).norm();
}

TEST(Correction, OfTwoBodiesTheSmallerDepthCounts) {
  EXPECT_NEAR(overlap_at_rest(with_min_depth(0.02), with_min_depth(0.06)), 0.02, 1e-5);
  EXPECT_NEAR(overlap_at_rest(with_min_depth(0.06), with_min_depth(0.02)), 0.02, 1e-5);
  EXPECT_NEAR(overlap_at_rest({}, with_min_depth(0.06)), 0.0, 1e-5);
}

TEST(Correction, OfTwoBodiesTheSmallerSpeedCounts) {
  WorldSpec spec = world_spec(kDt);
  spec.physics.gravity.setZero();
  for (const bool swapped : {false, true}) {
    const Surface slow = with_max_vel(0.2), fast = with_max_vel(0.6);
    TestWorld world(spec);
    Model& a =
        world.add(make_body("a", SphereShape{kRadius}, at(0, 0, 0), 1.0, swapped ? slow : fast));
    Model& b =
        world.add(make_body("b", SphereShape{kRadius}, at(0.9, 0, 0), 1.0, swapped ? fast : slow));
    world->step();
    EXPECT_NEAR(b.bodies[0]->velocity().x() - a.bodies[0]->velocity().x(), 0.2, 1e-4);
  }
}

/// What lies on something without a gap is held from the first step on, and a small gap closes.
TEST(Margin, NothingFallsIntoWhatItTouches) {
  for (const double gap : {-1e-12, 0.0, 1e-12, 1e-9}) {
    TestWorld world(world_spec(kDt));
    world.add(make_ground());
    const Model& box = world.add(make_body("m", BoxShape{{1, 1, 1}}, at(0, 0, 0.5 + gap)));
    world->step();
    EXPECT_NEAR(box.T_world_model().p.z(), 0.5, 1e-8) << gap;
  }
}

TEST(Margin, AGapClosesAndDoesNotHold) {
  TestWorld world(world_spec(kDt));
  world.add(make_ground());
  const Model& box = world.add(make_body("m", BoxShape{{1, 1, 1}}, at(0, 0, 0.5008)));
  world->step(3);
  EXPECT_NEAR(box.T_world_model().p.z(), 0.5, 1e-8);
  EXPECT_LT(box.bodies[0]->velocity().norm(), 1e-6);
}

/// Wherever in its last step before the ground the ball is found.
TEST(Margin, TakesNothingFromABounce) {
  constexpr double kSpeed = 3.0, kStep = 0.001, kRestitution = 0.7;
  Surface bouncy;
  bouncy.restitution = kRestitution;
  bouncy.bounce_threshold_m_s = 0.01;
  for (double height = 0.0; height < kSpeed * kStep; height += 1e-4) {
    WorldSpec spec = world_spec(kStep);
    spec.physics.gravity.setZero();
    TestWorld world(spec);
    world.add(make_ground(bouncy));
    Model& ball = world.add(
        make_body("m", SphereShape{kRadius}, at(0, 0, kRadius + 0.01 + height), 1.0, bouncy));
    world->set_model_twist(ball, {0, 0, -kSpeed}, {0, 0, 0});
    world->step(10);
    EXPECT_NEAR(ball.bodies[0]->velocity().z(), kRestitution * kSpeed, 1e-4) << height;
  }
}

TEST(Margin, AWheelRollsOnItsOwnRadius) {
  constexpr double kWheelRadius = 0.1, kSpeed = 1.0;
  TestWorld world(world_spec(kDt));
  world.add(make_ground());
  Model& wheel =
      world.add(make_body("m", CylinderShape{kWheelRadius, 0.2},
                          SE3::from_xyz_rpy({0, 0, kWheelRadius}, std::acos(0.0), 0, 0)));
  world->set_model_twist(wheel, {kSpeed, 0, 0}, {0, kSpeed / kWheelRadius, 0});
  world->step(500);
  EXPECT_NEAR(wheel.T_world_model().p.x(), 500 * kDt * kSpeed, 1e-3);
}

}  // namespace
}  // namespace trident::sim
