// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Contacts against closed forms, with each of the world's solvers.
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "test_world.h"

namespace trident::sim {
namespace {

constexpr double kGravity = 9.8, kMu = 0.4;

struct Solver {
  const char* name;
  const char* type;
  int exact_rows;
  double dt_s;
};

Surface with_mu(double mu) {
  Surface surface;
  surface.mu = surface.mu2 = mu;
  return surface;
}

class ClosedForm : public testing::TestWithParam<Solver> {
 protected:
  static WorldSpec spec() {
    WorldSpec spec = world_spec(GetParam().dt_s);
    spec.physics.solver = GetParam().type;
    spec.physics.exact_solver_rows = GetParam().exact_rows;
    spec.physics.iterations = 100;
    return spec;
  }
  void run(double seconds) {
    const SimTime end = world_->time() + SimTime::from_seconds(seconds);
    while (world_->time() < end) world_->step();
  }
  /// A ground that is turned down by `angle` about y, and a flat box that lies on it.
  Model& box_on_slope(double angle, double mu) {
    ModelSpec slope = make_ground(with_mu(100.0));
    slope.T_world_model = SE3::from_xyz_rpy({0, 0, 0}, 0, angle, 0);
    world_.add(std::move(slope));
    const SE3 T =
        SE3::from_xyz_rpy({0.05 * std::sin(angle), 0, 0.05 * std::cos(angle)}, 0, angle, 0);
    return world_.add(make_body("box", BoxShape{{0.4, 0.4, 0.1}}, T, 1.0, with_mu(mu)));
  }

  TestWorld world_{spec()};
};

TEST_P(ClosedForm, ABoxSlidesForSpeedSquaredOverTwoMuG) {
  world_.add(make_ground(with_mu(100.0)));
  Model& box =
      world_.add(make_body("box", BoxShape{{0.4, 0.4, 0.1}}, at(0, 0, 0.05), 1.0, with_mu(kMu)));
  run(0.2);
  const double start = box.T_world_model().p.x(), speed = 3.0;
  world_->set_model_twist(box, {speed, 0, 0}, {0, 0, 0});
  run(2.0);
  const double expected = speed * speed / (2 * kMu * kGravity);
  // A step's travel is the least that a step can resolve.
  EXPECT_NEAR(box.T_world_model().p.x() - start, expected, speed * GetParam().dt_s);
  EXPECT_NEAR(box.T_world_model().p.y(), 0.0, 1e-3);
}

TEST_P(ClosedForm, ASphereThatSlidesEndsRollingAtFiveSeventhsOfItsSpeed) {
  world_.add(make_ground(with_mu(100.0)));
  ModelSpec ball = make_body("ball", SphereShape{0.1}, at(0, 0, 0.1), 1.0, with_mu(kMu));
  ball.links[0].inertial.inertia_com = 0.4 * 0.01 * Eigen::Matrix3d::Identity();
  Model& model = world_.add(std::move(ball));
  run(0.2);
  world_->set_model_twist(model, {1, 0, 0}, {0, 0, 0});
  // It rolls after 2 v / (7 mu g).
  run(2.0 / (7 * kMu * kGravity) + 0.1);
  const Body& body = *model.bodies[0];
  EXPECT_NEAR(body.velocity().x(), 5.0 / 7.0, 2e-3);
  EXPECT_NEAR(body.velocity().x(), 0.1 * body.angular_velocity().y(), 1e-4);
  const double rolling = body.velocity().x();
  run(2.0);
  EXPECT_NEAR(body.velocity().x(), rolling, 1e-3) << "rolling has no friction";
}

TEST_P(ClosedForm, ABallReboundsToRestitutionSquaredOfItsHeight) {
  const double restitution = 0.7, drop = 1.0;
  Surface bouncy = with_mu(1.0);
  bouncy.restitution = restitution;
  bouncy.bounce_threshold_m_s = 0.01;
  world_.add(make_ground(bouncy));
  Model& ball = world_.add(make_body("ball", SphereShape{0.1}, at(0, 0, 0.1 + drop), 1.0, bouncy));
  while (ball.bodies[0]->velocity().z() <= 0.0 && world_->time().seconds() < 2.0) world_->step();
  double top = 0.0;
  while (ball.bodies[0]->velocity().z() > 0.0) {
    world_->step();
    top = std::max(top, ball.T_world_model().p.z() - 0.1);
  }
  // The step in which it hits is a step too long or too short: +-v dt.
  EXPECT_NEAR(top, restitution * restitution * drop, 4.5 * GetParam().dt_s);
}

TEST_P(ClosedForm, OnASlopeABoxSticksBelowTheAngleOfFrictionAndSlidesAbove) {
  const double critical = std::atan(kMu);
  {
    Model& box = box_on_slope(0.97 * critical, kMu);
    run(0.1);
    const Eigen::Vector3d start = box.T_world_model().p;
    run(5.0);
    EXPECT_LT((box.T_world_model().p - start).norm(), 1e-3);
    world_->remove("box");
    world_->remove("ground");
  }
  const double angle = 1.03 * critical;
  Model& box = box_on_slope(angle, kMu);
  run(0.1);
  const double before = box.bodies[0]->velocity().norm();
  run(1.0);
  const double acceleration = kGravity * (std::sin(angle) - kMu * std::cos(angle));
  EXPECT_NEAR(box.bodies[0]->velocity().norm() - before, acceleration, 0.02 * acceleration + 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Solvers, ClosedForm,
                         testing::Values(Solver{"world_10ms", "world", 150, 0.01},
                                         Solver{"world_1ms", "world", 150, 0.001},
                                         Solver{"quick_10ms", "quick", 150, 0.01},
                                         Solver{"iterations_10ms", "quick", 0, 0.01},
                                         Solver{"iterations_1ms", "quick", 0, 0.001}),
                         [](const auto& info) { return std::string(info.param.name); });

/// Ten boxes on each other at rest for a minute.
struct Tower {
  const char* name;
  double dt_s, gap_m, mu;
};
class Stack : public testing::TestWithParam<Tower> {};

TEST_P(Stack, OfTenBoxesStandsWithoutCreeping) {
  WorldSpec spec = world_spec(GetParam().dt_s);
  spec.physics.solver = "quick";
  spec.physics.iterations = 1000;
  TestWorld world(spec);
  const Surface surface = with_mu(GetParam().mu);
  world.add(make_ground(surface));
  std::vector<Model*> boxes;
  for (int i = 0; i < 10; ++i) {
    const double z = 0.1 + 0.2 * i + GetParam().gap_m * (i + 1);
    boxes.push_back(&world.add(make_body("box" + std::to_string(i), BoxShape{{0.2, 0.2, 0.2}},
                                         at(0, 0, z), 1.0, surface)));
  }
  const auto steps = [&](double seconds) {
    return static_cast<std::uint64_t>(std::lround(seconds / GetParam().dt_s));
  };
  world->step(steps(2.0));
  std::vector<SE3> settled;
  for (const Model* box : boxes) settled.push_back(box->T_world_model());
  EXPECT_TRUE(is_near(settled.back().p, {0, 0, 1.9}, 1e-4));
  world->step(steps(60.0));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const SE3 T = boxes[i]->T_world_model();
    EXPECT_TRUE(is_near(T.p, settled[i].p, 1e-4)) << "box " << i;
    EXPECT_LT(T.R.angularDistance(settled[i].R), 1e-4) << "box " << i;
    EXPECT_LT(boxes[i]->bodies[0]->velocity().norm(), 1e-5) << "box " << i;
  }
}
INSTANTIATE_TEST_SUITE_P(Towers, Stack,
                         testing::Values(Tower{"placed_10ms", 0.01, 0.0, 1.0},
                                         Tower{"placed_10ms_mu_08", 0.01, 0.0, 0.8},
                                         Tower{"dropped_10ms", 0.01, 0.01, 1.0},
                                         Tower{"placed_1ms", 0.001, 0.0, 1.0},
                                         Tower{"dropped_1ms", 0.001, 0.01, 1.0}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace trident::sim
