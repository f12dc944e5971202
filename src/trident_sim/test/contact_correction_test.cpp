// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "test_world.h"

namespace trident {
namespace {

constexpr double kDt = 0.01, kRadius = 0.5, kLayer = 0.001;
/// Less than gravity takes away in a step, so that a body does not leave what pushes it out.
constexpr double kGently = 0.05;
/// Softness of a contact: what a newton takes from the speed of being pushed out [m/s].
constexpr double kSoftness = 1e-8;

Surface with_max_vel(double max_vel_m_s) {
  Surface surface;
  surface.max_vel_m_s = max_vel_m_s;
  return surface;
}
Surface with_min_depth(double min_depth_m) {
  Surface surface = with_max_vel(kGently);
  surface.min_depth_m = min_depth_m;
  return surface;
}

/// A ball put 0.1 m deep into the ground.
struct SunkenBall {
  explicit SunkenBall(const Surface& surface, const Surface& of_ground = {},
                      const WorldSpec& spec = world_spec(kDt))
      : world(spec) {
    world.add(make_ground(of_ground));
    ball = &world.add(make_body("m", SphereShape{kRadius}, at(0, 0, kRadius - 0.1), 1.0, surface));
  }
  double depth() const { return kRadius - ball->T_world_model().p.z(); }
  double depth_at_rest() {
    world->step(1000);
    EXPECT_LT(ball->bodies[0]->v_world.norm(), 1e-4);
    return depth();
  }
  double speed_after_one_step() {
    world->step();
    return ball->bodies[0]->v_world.z();
  }
  TestWorld world;
  Model* ball;
};

class MinDepth : public testing::TestWithParam<double> {};

TEST_P(MinDepth, IsWhereABodyComesToRest) {
  EXPECT_NEAR(SunkenBall(with_min_depth(GetParam())).depth_at_rest(), GetParam(), 1e-5);
}
INSTANTIATE_TEST_SUITE_P(Depths, MinDepth, testing::Values(0.0, 0.0005, 0.001, 0.004, 0.05));

TEST(MinDepth, IsTheWorldsLayerByDefault) {
  const Surface gentle = with_max_vel(kGently);
  EXPECT_NEAR(SunkenBall(gentle).depth_at_rest(), kLayer, 1e-5);
  WorldSpec spec = world_spec(kDt);
  spec.physics.contact_surface_layer = 0.02;
  EXPECT_NEAR(SunkenBall(gentle, {}, spec).depth_at_rest(), 0.02, 1e-5);
  EXPECT_NEAR(SunkenBall(with_min_depth(0.01), {}, spec).depth_at_rest(), 0.01, 1e-5);
}

TEST(MinDepth, NothingShallowerIsPushedOut) {
  const double sinks = kSoftness * 9.8 * 1000 * kDt;
  EXPECT_NEAR(SunkenBall(with_min_depth(0.3)).depth_at_rest(), 0.1 + sinks, 1e-5);
}

/// What the speed of being pushed out is bounded to, and nothing else.
class MaxVel : public testing::TestWithParam<double> {};

TEST_P(MaxVel, IsTheSpeedAtWhichABodyIsPushedOut) {
  SunkenBall sunken(with_max_vel(GetParam()));
  const double force_n = GetParam() / kDt + 9.8;
  const double speed = GetParam() - kSoftness * force_n;
  EXPECT_NEAR(sunken.speed_after_one_step(), speed, 1e-6);
  EXPECT_NEAR(sunken.depth(), 0.1 - speed * kDt, 1e-8);
}
INSTANTIATE_TEST_SUITE_P(Speeds, MaxVel, testing::Values(0.0, 0.01, 0.5, 2.0));

TEST(MaxVel, IsTheWorldsByDefaultAndAtMost) {
  WorldSpec spec = world_spec(kDt);
  spec.physics.contact_max_correcting_vel = 0.3;
  EXPECT_NEAR(SunkenBall({}, {}, spec).speed_after_one_step(), 0.3, 1e-4);
  EXPECT_NEAR(SunkenBall(with_max_vel(5.0), {}, spec).speed_after_one_step(), 0.3, 1e-4);
  EXPECT_NEAR(SunkenBall(with_max_vel(0.1), {}, spec).speed_after_one_step(), 0.1, 1e-4);
}

TEST(MaxVel, DoesNotBoundABounce) {
  Surface bouncy = with_max_vel(0.01);
  bouncy.restitution = 0.5;
  bouncy.bounce_threshold_m_s = 0.01;
  SunkenBall ball(bouncy, bouncy);
  ball.world->set_model_twist(*ball.ball, {0, 0, -2}, {0, 0, 0});
  EXPECT_NEAR(ball.speed_after_one_step(), 1.0, 1e-3);
}

TEST(MaxVel, AndMinDepthHoldTogether) {
  SunkenBall sunken(with_min_depth(0.05));
  EXPECT_NEAR(sunken.speed_after_one_step(), kGently, 1e-4);
  EXPECT_NEAR(sunken.depth_at_rest(), 0.05, 1e-5);
}

TEST(Correction, AStaticSurfaceHasNoSay) {
  Surface ground = with_max_vel(0.01);
  ground.min_depth_m = 0.05;
  SunkenBall plain({}), on_ground({}, ground);
  EXPECT_EQ(plain.speed_after_one_step(), on_ground.speed_after_one_step());
  EXPECT_NEAR(SunkenBall(with_max_vel(kGently), ground).depth_at_rest(), kLayer, 1e-5);
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
  EXPECT_NEAR(overlap_at_rest(with_max_vel(kGently), with_min_depth(0.06)), kLayer, 1e-5);
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
    EXPECT_NEAR(b.bodies[0]->v_world.x() - a.bodies[0]->v_world.x(), 0.2, 1e-4);
  }
}

TEST(Correction, TheWorldsOwnValuesChangeNoBit) {
  Surface same = with_min_depth(kLayer);
  same.max_vel_m_s = 100.0;
  SunkenBall plain({}), told(same);
  for (int i = 0; i < 200; ++i) {
    plain.world->step();
    told.world->step();
    ASSERT_EQ(plain.world->state_hash(), told.world->state_hash()) << i;
  }
}

}  // namespace
}  // namespace trident
