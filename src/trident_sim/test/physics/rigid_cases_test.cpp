// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Bodies that are dropped, slid and rolled, with Gazebo's defaults, against sums over the same
// steps: semi-implicit Euler falls, and Coulomb's friction takes mu g dt of the speed in each step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models.h"
#include "test_world.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

constexpr double kGravity = 9.8, kHalf = 0.1;

struct Setting {
  const char* name;
  double dt_s;
  int exact_rows;
};

ModelSpec ball(const std::string& name, const SE3& T_world_model) {
  ModelSpec spec = make_body(name, SphereShape{kHalf}, T_world_model);
  spec.links[0].inertial.inertia_com = 0.004 * Eigen::Matrix3d::Identity();
  return spec;
}
ModelSpec box(const std::string& name, const SE3& T_world_model, double mu = 1.0) {
  Surface surface;
  surface.mu = surface.mu2 = mu;
  return make_body(name, BoxShape{{0.2, 0.2, 0.2}}, T_world_model, 1.0, surface);
}
ModelSpec brick(const std::string& name, const SE3& T_world_model) {
  ModelSpec spec = make_body(name, BoxShape{{0.4, 0.3, 0.1}}, T_world_model);
  spec.links[0].inertial.inertia_com =
      Eigen::Vector3d(0.0083333, 0.0141667, 0.0208333).asDiagonal();
  return spec;
}

double kinetic_energy(const Body& body) {
  const Eigen::Vector3d w = body.rotation().transpose() * body.angular_velocity();
  return 0.5 * body.mass() * body.velocity().squaredNorm() + 0.5 * w.dot(body.inertia_tensor() * w);
}
double energy(const Body& body) {
  return kinetic_energy(body) + body.mass() * kGravity * body.pose().p.z();
}

/// Angle between the vertical and the axis of a body that is nearest to it [rad].
double tilt(const Body& body) {
  return std::acos(std::min(1.0, body.rotation().row(2).cwiseAbs().maxCoeff()));
}

class RigidCase : public testing::TestWithParam<Setting> {
 protected:
  static WorldSpec spec() {
    WorldSpec spec = world_spec(GetParam().dt_s);
    spec.physics.solver = "quick";
    spec.physics.exact_solver_rows = GetParam().exact_rows;
    spec.physics.iterations = 1000;
    return spec;
  }
  double dt() const { return GetParam().dt_s; }
  Body& add(ModelSpec model, const Eigen::Vector3d& v = {0, 0, 0},
            const Eigen::Vector3d& w = {0, 0, 0}) {
    Surface ground;
    ground.mu = 100.0;
    ground.mu2 = 50.0;
    world_.add(make_ground(ground));
    Model& spawned = world_.add(std::move(model));
    world_->set_model_twist(spawned, v, w);
    return *spawned.bodies[0];
  }
  bool continues(double end_s) { return world_->time() < SimTime::from_seconds(end_s); }

  TestWorld world_{spec()};
};

/// Falls from 1.1 m, is where it fell to in the step in which it hits, and lies there from the
/// next.
void expect_to_drop(TestWorld& world, const Body& body, double dt_s) {
  double z = body.pose().p.z(), v = 0.0;
  while (z > kHalf) {
    v -= kGravity * dt_s;
    z += v * dt_s;
    world->step();
    ASSERT_NEAR(body.pose().p.z(), z, 1e-3) << world->time().seconds();
  }
  while (world->time() < SimTime::from_seconds(3.0)) {
    world->step();
    ASSERT_NEAR(body.pose().p.z(), kHalf, 1e-5) << world->time().seconds();
    ASSERT_LT(std::abs(body.velocity().z()), 0.0101) << "max_vel is what may remain";
  }
  EXPECT_LT(body.velocity().norm(), 1e-6);
  EXPECT_LT(body.pose().p.head<2>().norm(), 1e-6);
  EXPECT_LT(tilt(body), 1e-6);
}

TEST_P(RigidCase, ABoxThatIsDroppedLiesStillAtOnce) {
  const Body& body = add(box("m", at(0, 0, 1.1)));
  expect_to_drop(world_, body, dt());
}

TEST_P(RigidCase, ABallThatIsDroppedLiesStillAtOnce) {
  const Body& body = add(ball("m", at(0, 0, 1.1)));
  expect_to_drop(world_, body, dt());
}

TEST_P(RigidCase, ABoxAboutToTipSlidesForCoulombsSum) {
  for (const double mu : {0.3, 0.7, 1.0}) {
    const std::string name = "m" + std::to_string(mu);
    if (world_->find_model("ground") != nullptr) world_->remove("ground");
    const Body& body = add(box(name, at(0, 0, kHalf), mu), {2, 0, 0});
    double x = 0.0, greatest_tilt = 0.0;
    for (double v = 2.0 - mu * kGravity * dt(); v > 0.0; v -= mu * kGravity * dt()) x += v * dt();
    const double end = world_->time().seconds() + 2.0 / (mu * kGravity) + 0.5;
    while (continues(end)) {
      world_->step();
      greatest_tilt = std::max(greatest_tilt, tilt(body));
    }
    EXPECT_NEAR(body.pose().p.x(), x, 1e-3) << "mu " << mu;
    EXPECT_LT(rad_to_deg(greatest_tilt), 0.2) << "mu " << mu;
    EXPECT_LT(std::abs(body.pose().p.y()), 1e-4);
    EXPECT_NEAR(body.pose().p.z(), kHalf, 1e-5);
    EXPECT_LT(body.velocity().norm(), 1e-5);
    world_->remove(name);
  }
}

TEST_P(RigidCase, ABallThatRollsContinues) {
  const Body& body = add(ball("m", at(0, 0, kHalf)), {1, 0, 0}, {0, 10, 0});
  while (continues(8.0)) {
    world_->step();
    ASSERT_NEAR(body.pose().p.x(), world_->time().seconds(), 1e-4);
    ASSERT_NEAR(body.pose().p.z(), kHalf, 1e-5);
  }
}

TEST_P(RigidCase, ABallThatSlidesIsSlowedUntilItRolls) {
  const Body& body = add(ball("m", at(0, 0, kHalf)), {1, 0, 0});
  double x = 0.0, v = 1.0, w = 0.0;
  while (continues(8.0)) {
    // What friction takes from the speed, a ball's slip loses three and a half times.
    const double taken = std::min(kGravity * dt(), (v - kHalf * w) / 3.5);
    v -= taken;
    w += 2.5 * taken / kHalf;
    x += v * dt();
    world_->step();
    ASSERT_NEAR(body.pose().p.x(), x, 1e-4) << world_->time().seconds();
  }
  EXPECT_NEAR(body.velocity().x(), 5.0 / 7.0, 1e-5);
}

TEST_P(RigidCase, ABoxThatFallsOnACornerComesToRestOnAFace) {
  const Body& body = add(box("m", SE3::from_xyz_rpy({3, 0, 1.1}, 0.3, 0.2, 0)));
  double before = energy(body);
  while (continues(8.0)) {
    world_->step();
    EXPECT_LE(energy(body), before + 1e-6) << world_->time().seconds();
    before = energy(body);
  }
  EXPECT_NEAR(body.pose().p.z(), kHalf, 1e-5);
  EXPECT_LT(tilt(body), 1e-5);
  EXPECT_LT(body.velocity().norm(), 1e-6);
  EXPECT_LT(body.angular_velocity().norm(), 1e-6);
}

TEST_P(RigidCase, ABrickThatTumblesComesToRestOnAFace) {
  const Body& body = add(brick("m", at(-20, 0, 30)), {1, 0, 0}, {0.1, 5, 0.1});
  const double start = energy(body);
  double lowest = start;
  while (continues(8.0)) {
    world_->step();
    // The steps of its tumbling are explicit; what it turns at 17 rad/s it gains a little of.
    EXPECT_LE(energy(body), lowest + 0.006) << world_->time().seconds();
    lowest = std::min(lowest, energy(body));
  }
  EXPECT_NEAR(body.pose().p.z(), 0.05, 1e-5);
  EXPECT_LT(tilt(body), 1e-5);
  EXPECT_LT(body.velocity().norm(), 1e-6);
  EXPECT_LT(body.angular_velocity().norm(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Solvers, RigidCase,
                         testing::Values(Setting{"exact_10ms", 0.01, 150},
                                         Setting{"exact_1ms", 0.001, 150},
                                         Setting{"iterations_10ms", 0.01, 0}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace trident::sim
