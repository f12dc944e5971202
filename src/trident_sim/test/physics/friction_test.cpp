// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "models.h"
#include "test_world.h"

namespace trident::sim {
namespace {

Surface with_mu(double mu, double mu2) {
  Surface surface;
  surface.mu = mu;
  surface.mu2 = mu2;
  return surface;
}
Surface with_mu(double mu) { return with_mu(mu, mu); }

/// How far a box slides from 2 m/s along x (or y) until it stands, or in four seconds.
double slide(const Surface& box, const Surface& ground,
             const Eigen::Vector3d& v_world = {2, 0, 0}) {
  TestWorld world(world_spec(0.002));
  world.add(make_ground(ground));
  Model& model = world.add(make_body("m", BoxShape{{0.4, 0.4, 0.1}}, at(0, 0, 0.05), 1.0, box));
  world->step(50);
  const Eigen::Vector3d start = model.T_world_model().p;
  world->set_model_twist(model, v_world, {0, 0, 0});
  world->step(2000);
  return (model.T_world_model().p - start).norm();
}

class Sliding : public testing::TestWithParam<double> {};

TEST_P(Sliding, DistanceIsSpeedSquaredOverTwoMuG) {
  const double expected = 2.0 * 2.0 / (2.0 * GetParam() * 9.8);
  EXPECT_NEAR(slide(with_mu(GetParam()), with_mu(100.0)), expected, 0.02 * expected + 0.003);
}
INSTANTIATE_TEST_SUITE_P(Mu, Sliding, testing::Values(0.1, 0.2, 0.5, 0.9));

/// Where a box stops that slides and spins, to the bit. `disturb` runs in mid-slide.
Eigen::Vector3d end_of_slide(
    TestWorld& world, Model& model, const std::function<void()>& disturb = [] {}) {
  world->step(50);
  world->set_model_twist(model, {2, 0.3, 0}, {0, 0, 4});
  world->step(100);
  disturb();
  world->step(400);
  return model.T_world_model().p;
}

TEST(Friction, AModelThatComesElsewhereChangesNoBitOfASlide) {
  const auto run = [](bool disturbed) {
    TestWorld world(world_spec(0.002));
    world.add(make_ground(with_mu(0.3)));
    Model& model = world.add(make_body("m", BoxShape{{0.4, 0.4, 0.3}}, at(0, 0, 0.15), 1.0, {}));
    return end_of_slide(world, model, [&] {
      // Its name is before the other's, so that the bodies get other numbers.
      if (disturbed) world.add(make_body("a", BoxShape{{0.4, 0.4, 0.1}}, at(9, 9, 0.05), 1.0, {}));
    });
  };
  EXPECT_EQ(run(true), run(false));
}

TEST(Friction, AResetForgetsTheContactsOfTheLastStep) {
  TestWorld world(world_spec(0.002));
  world.add(make_ground(with_mu(0.3)));
  Model& model = world.add(make_body("m", BoxShape{{0.4, 0.4, 0.3}}, at(0, 0, 0.15), 1.0, {}));
  const Eigen::Vector3d first = end_of_slide(world, model);
  world->reset();
  EXPECT_EQ(end_of_slide(world, model), first);
}

TEST(Friction, TheSlipperierSurfaceDecides) {
  EXPECT_NEAR(slide(with_mu(0.2), with_mu(100.0)), slide(with_mu(100.0), with_mu(0.2)), 1e-6);
}

TEST(Friction, WithoutItNothingStops) {
  EXPECT_NEAR(slide(with_mu(0.0), with_mu(100.0)), 2.0 * 4.0, 1e-3);
}

TEST(Friction, TheTwoDirectionsMayDiffer) {
  Surface skate = with_mu(0.1, 0.8);
  skate.fdir1 = {1, 0, 0};
  const double along = slide(skate, with_mu(100.0), {2, 0, 0});
  const double across = slide(skate, with_mu(100.0), {0, 2, 0});
  EXPECT_NEAR(along, 4.0 / (2 * 0.1 * 9.8), 0.05);
  EXPECT_NEAR(across, 4.0 / (2 * 0.8 * 9.8), 0.02);
}

TEST(Friction, TheFirstDirectionTurnsWithTheLink) {
  Surface skate = with_mu(0.1, 0.8);
  skate.fdir1 = {1, 0, 0};
  TestWorld world(world_spec(0.002));
  world.add(make_ground(with_mu(100.0)));
  ModelSpec spec = make_body("m", BoxShape{{0.4, 0.4, 0.1}}, at(0, 0, 0.05), 1.0, skate);
  // The skate is a second link, turned by 90 degrees on a base without collisions.
  spec.links.insert(spec.links.begin(), make_link("base", 0.1, {1e-3, 1e-3, 1e-3}));
  spec.links[1].T_model_link = SE3::from_xyz_rpy({0, 0, 0}, 0, 0, std::acos(0.0));
  spec.joints.push_back(make_joint("j", JointType::kFixed, "base", "link", {}, {0, 0, 1}));
  Model& model = world.add(std::move(spec));
  world->step(50);
  world->set_model_twist(model, {0, 2, 0}, {0, 0, 0});
  world->step(2000);
  EXPECT_NEAR(model.T_world_model().p.y(), 4.0 / (2 * 0.1 * 9.8), 0.05);
}

TEST(Friction, ASphereThatSlidesEndsRolling) {
  TestWorld world(world_spec(0.002));
  world.add(make_ground(with_mu(100.0)));
  ModelSpec spec = make_body("m", SphereShape{0.1}, at(0, 0, 0.1), 1.0, with_mu(0.5));
  spec.links[0].inertial.inertia_com = 0.4 * 0.01 * Eigen::Matrix3d::Identity();
  Model& ball = world.add(std::move(spec));
  world->step(50);
  world->set_model_twist(ball, {1, 0, 0}, {0, 0, 0});
  world->step(500);
  EXPECT_NEAR(ball.bodies[0]->v_world.x(), 5.0 / 7.0, 0.01);
  EXPECT_NEAR(ball.bodies[0]->w_world.y(), 50.0 / 7.0, 0.1);
}

TEST(Friction, ItHoldsOnASlopeUpToItsAngle) {
  for (const double mu : {0.3, 0.5}) {
    const double angle = std::atan(0.4);
    TestWorld world(world_spec(0.002));
    ModelSpec slope = make_ground(with_mu(100.0));
    slope.T_world_model = SE3::from_xyz_rpy({0, 0, 0}, 0, angle, 0);
    world.add(std::move(slope));
    Model& box = world.add(make_body(
        "m", BoxShape{{0.4, 0.4, 0.1}},
        SE3::from_xyz_rpy({0.05 * std::sin(angle), 0, 0.05 * std::cos(angle)}, 0, angle, 0), 1.0,
        with_mu(mu)));
    world->step(500);
    const double speed = box.bodies[0]->v_world.norm();
    if (mu < 0.4) {
      EXPECT_NEAR(speed, 9.8 * (std::sin(angle) - mu * std::cos(angle)), 0.05);
    } else {
      EXPECT_LT(speed, 5e-3);
    }
  }
}

}  // namespace
}  // namespace trident::sim
