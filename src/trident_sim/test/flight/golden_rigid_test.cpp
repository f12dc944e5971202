// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "golden_data.h"
#include "golden_world.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

constexpr double kRigidStep_s = 0.01, kGravity = 9.8;

std::vector<std::vector<double>> rigid(const std::string& name) {
  return read_csv(golden_folder() + "/rigid_dt0.01/" + name + ".csv");
}
GoldenWorld rigid_world() { return GoldenWorld(golden_folder() + "/rigid_dt0.01/world.sdf"); }

/// Mechanical energy per kilogram of a body that does not turn [J/kg].
double energy(const Model& model) {
  const Body& body = *model.bodies[0];
  return 0.5 * body.velocity().squaredNorm() + kGravity * body.pose().p.z();
}

class GoldenDrop : public testing::TestWithParam<const char*> {};

TEST_P(GoldenDrop, FallsAndComesToRestAsInGazeboWithoutGainingEnergy) {
  TRIDENT_NEEDS_GOLDEN();
  const auto rows = rigid(GetParam());
  GoldenWorld world = rigid_world();
  Model& body = *world->find_model(GetParam());
  double before = energy(body);
  for (const auto& row : rows) {
    while (world->time() < SimTime::from_seconds(row[0])) world->step();
    EXPECT_LE(energy(body), before + 1e-6) << "at " << row[0] << " s";
    before = energy(body);
    EXPECT_TRUE(is_near(body.T_world_model().p, {row[1], row[2], row[3]}, 1e-6))
        << "at " << row[0] << " s";
    EXPECT_NEAR(body.bodies[0]->velocity().z(), row[10], 1e-5) << "at " << row[0] << " s";
  }
}
INSTANTIATE_TEST_SUITE_P(Bodies, GoldenDrop, testing::Values("box_drop", "sphere_drop"));

/// Euler's equations for a box without torque, by Runge and Kutta's method at a thousandth of the
/// simulation's step: as good as a closed form.
struct FreeTumble {
  Eigen::Vector3d inertia, w_body;
  Eigen::Quaterniond R = Eigen::Quaterniond::Identity();

  Eigen::Vector3d rate(const Eigen::Vector3d& w) const {
    return -w.cross(inertia.cwiseProduct(w)).cwiseQuotient(inertia);
  }
  void advance(double h) {
    const Eigen::Vector3d k1 = rate(w_body), k2 = rate(w_body + 0.5 * h * k1);
    const Eigen::Vector3d k3 = rate(w_body + 0.5 * h * k2), k4 = rate(w_body + h * k3);
    const Eigen::Vector3d middle = w_body + 0.5 * h * k2;
    w_body += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    R = (R * Eigen::AngleAxisd(h * middle.norm(), middle.normalized())).normalized();
  }
  Eigen::Vector3d momentum() const { return R * inertia.cwiseProduct(w_body); }
};

TEST(GoldenTumble, StaysNearTheClosedFormAndConservesMomentum) {
  TRIDENT_NEEDS_GOLDEN();
  GoldenWorld world = rigid_world();
  Model& box = *world->find_model("free_tumble");
  FreeTumble exact{{0.0083333, 0.0141667, 0.0208333}, {0.1, 5.0, 0.1}};
  world->set_model_twist(box, {1, 0, 0}, exact.w_body);
  const Eigen::Vector3d momentum = exact.momentum();
  const double energy = exact.w_body.dot(exact.inertia.cwiseProduct(exact.w_body));
  double worst_angle = 0.0;
  while (world->step_count() < 100) {
    world->step();
    for (int i = 0; i < 1000; ++i) exact.advance(kRigidStep_s / 1000);
    worst_angle = std::max(worst_angle, box.T_world_model().R.angularDistance(exact.R));
  }
  ASSERT_TRUE(is_near(exact.momentum(), momentum, 1e-6));
  const Body& body = *box.bodies[0];
  const Eigen::Vector3d w = body.rotation().transpose() * body.angular_velocity();
  EXPECT_TRUE(
      is_near(body.rotation() * (body.inertia_tensor() * w), momentum, 0.05 * momentum.norm()));
  EXPECT_NEAR(w.dot(body.inertia_tensor() * w), energy, 0.05 * energy);
  EXPECT_LT(rad_to_deg(worst_angle), 5.0);
  EXPECT_NEAR(box.T_world_model().p.x(), -20.0 + 1.0, 1e-9);
  // Semi-implicit Euler falls g dt t / 2 further than the parabola.
  EXPECT_NEAR(box.T_world_model().p.z(), 30.0 - 0.5 * kGravity * (1.0 + kRigidStep_s), 1e-9);
}

/// Gazebo's own stays on an edge, 1.4 mm low, and rocks there.
TEST(GoldenTumble, ComesToRestOnAFace) {
  TRIDENT_NEEDS_GOLDEN();
  GoldenWorld world = rigid_world();
  Model& box = *world->find_model("free_tumble");
  world->set_model_twist(box, {1, 0, 0}, {0.1, 5.0, 0.1});
  world->step(800);
  EXPECT_NEAR(box.T_world_model().p.z(), 0.05, 1e-5);
  EXPECT_LT(box.bodies[0]->velocity().norm(), 1e-6);
  EXPECT_LT(box.bodies[0]->angular_velocity().norm(), 1e-6);
}

TEST(GoldenTumble, FollowsGazeboUntilTheGround) {
  TRIDENT_NEEDS_GOLDEN();
  GoldenWorld world = rigid_world();
  Model& box = *world->find_model("free_tumble");
  world->set_model_twist(box, {1, 0, 0}, {0.1, 5.0, 0.1});
  Deviation deviation;
  for (const auto& row : rigid("free_tumble")) {
    if (row[3] < 0.26) break;  // no corner is further out
    while (world->time() < SimTime::from_seconds(row[0])) world->step();
    deviation.add(box.T_world_model(),
                  {Eigen::Quaterniond(row[7], row[4], row[5], row[6]).normalized(),
                   {row[1], row[2], row[3]}});
  }
  EXPECT_LT(deviation.position_m, 1e-6);
  EXPECT_LT(deviation.angle_deg, 0.01);
  RecordProperty("angle_deg", std::to_string(deviation.angle_deg));
}

}  // namespace
}  // namespace trident::sim
