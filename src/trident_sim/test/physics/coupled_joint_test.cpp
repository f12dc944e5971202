// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Screw and gearbox joints against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "test_world.h"

namespace trident::sim {
namespace {

constexpr double kPi = 3.14159265358979323846, kStandardGravity = 9.8;

/// Kinetic and potential energy of all bodies [J].
double energy(const Model& model) {
  double sum = 0.0;
  for (const auto& body : model.bodies) {
    const Eigen::Vector3d w = body->rotation().transpose() * body->angular_velocity();
    sum += 0.5 * body->mass() * body->velocity().squaredNorm() +
           0.5 * w.dot(body->inertia_tensor() * w) +
           body->weight_mass() * kStandardGravity * body->pose().p.z();
  }
  return sum;
}

class Screw : public testing::TestWithParam<double> {};

/// A nut of mass m and inertia I on a thread of lead k [m/rad] falls with g k^2 / (k^2 + I / m).
TEST_P(Screw, FallsAsItsInertiaLetsIt) {
  const double pitch = GetParam(), k = pitch / (2 * kPi);
  TestWorld world(world_spec(0.001));
  ModelSpec spec = make_on_world(JointType::kScrew, {0, 0, 0}, {0, 0, 1});
  spec.joints[0].screw_pitch_m = pitch;
  Model& model = world.add(std::move(spec));
  const Joint& joint = *model.find_joint("j");
  world->step(1000);
  const double fall = kStandardGravity * k * k / (k * k + 0.04);
  const Eigen::Vector3d p = model.links[0]->T_world_link().p;
  EXPECT_NEAR(model.bodies[0]->velocity().z(), -fall, 2e-3 * fall + 1e-9);
  EXPECT_NEAR(p.z(), -0.5 * fall, 5e-3 * fall);
  EXPECT_NEAR(joint.position(), p.z() / k, 1e-3 * std::abs(p.z() / k)) << "turns are counted";
  EXPECT_NEAR(joint.velocity(), model.bodies[0]->velocity().z() / k, 1e-3 * std::abs(fall / k));
  EXPECT_LT(p.head<2>().norm(), 1e-6);
  EXPECT_NEAR(energy(model), 0.0, 0.01 * kStandardGravity * std::abs(p.z()));
}
INSTANTIATE_TEST_SUITE_P(Pitches, Screw, testing::Values(0.5, -0.5, 2.0, 0.01));

TEST(ScrewJoint, EffortTurnsItAndLimitsAreOnTheAngle) {
  TestWorld world(weightless());
  ModelSpec spec = make_on_world(JointType::kScrew, {0, 0, 0}, {1, 0, 0});
  spec.joints[0].screw_pitch_m = 0.1;
  spec.joints[0].upper = 8.0;  // more than a turn
  Model& model = world.add(std::move(spec));
  world->apply_effort({model.find_joint("j"), 0.02, {}, {-1}});
  world->step(6000);
  EXPECT_NEAR(model.find_joint("j")->position(), 8.0, 0.02);
  EXPECT_NEAR(model.links[0]->T_world_link().p.x(), 8.0 * 0.1 / (2 * kPi), 1e-3);
}

TEST(ScrewJoint, BetweenTwoBodiesItKeepsTheirMomentum) {
  TestWorld world(weightless());
  ModelSpec spec;
  spec.name = "m";
  spec.links.push_back(make_link("a", 2.0, {0.1, 0.2, 0.3}));
  spec.links.push_back(make_link("b", 1.0, {0.02, 0.03, 0.04}, at(0, 0, 0.3)));
  spec.joints.push_back(make_joint("j", JointType::kScrew, "a", "b", {}, {0, 0, 1}));
  spec.joints[0].screw_pitch_m = 0.4;
  Model& model = world.add(std::move(spec));
  world->apply_effort({model.find_joint("j"), 0.05, {}, {-1}});
  world->step(1000);
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero();
  for (const auto& body : model.bodies) {
    const Eigen::Matrix3d& R = body->rotation();
    momentum += body->mass() * body->velocity();
    spin += R * body->inertia_tensor() * R.transpose() * body->angular_velocity() +
            body->mass() * body->pose().p.cross(body->velocity());
  }
  EXPECT_LT(momentum.norm(), 1e-6);
  EXPECT_LT(spin.norm(), 1e-6);
  EXPECT_GT(model.find_joint("j")->velocity(), 0.5);
  EXPECT_NEAR(model.bodies[1]->velocity().z() - model.bodies[0]->velocity().z(),
              0.4 / (2 * kPi) * model.find_joint("j")->velocity(), 1e-3);
}

struct Gears {
  const char* name;
  double ratio;
  Eigen::Vector3d axis2;
};
class Gearbox : public testing::TestWithParam<Gears> {
 protected:
  /// Two wheels hinged to a case, which stands in the world or is free, geared to each other.
  static ModelSpec gearbox(bool is_case_free) {
    ModelSpec model;
    model.name = "m";
    const Eigen::Vector3d inertia = Eigen::Vector3d::Constant(0.05);
    model.links.push_back(make_link("case", 5.0, Eigen::Vector3d::Constant(0.8)));
    model.links.push_back(make_link("in", 1.0, inertia, at(0.3, 0, 0)));
    model.links.push_back(make_link("out", 1.0, 2 * inertia, at(-0.3, 0.1, 0)));
    const Eigen::Vector3d axis(0, 0, 1), axis2 = GetParam().axis2.normalized();
    if (!is_case_free) {
      model.joints.push_back(make_joint("fix", JointType::kFixed, "world", "case", {}, axis));
    }
    model.joints.push_back(
        make_joint("in", JointType::kRevolute, "case", "in", at(0.3, 0, 0), axis));
    model.joints.push_back(
        make_joint("out", JointType::kRevolute, "case", "out", at(-0.3, 0.1, 0), axis2));
    model.joints.push_back(make_joint("gear", JointType::kGearbox, "in", "out", {}, axis));
    model.joints.back().axis2.axis_model = axis2;
    model.joints.back().gearbox_ratio = GetParam().ratio;
    model.joints.back().gearbox_reference_body = "case";
    return model;
  }
};

TEST_P(Gearbox, TurnsAtItsRatioWithTheInertiaOfBothWheels) {
  TestWorld world(weightless());
  Model& model = world.add(gearbox(false));
  const double ratio = GetParam().ratio, torque = 0.1;
  world->apply_effort({model.find_joint("in"), torque, {}, {-1}});
  world->step(2000);
  const Joint &in = *model.find_joint("in"), &out = *model.find_joint("out");
  const double acceleration = torque / (0.05 + ratio * ratio * 0.1);
  EXPECT_NEAR(in.velocity(), 2.0 * acceleration, 0.01 * acceleration);
  EXPECT_NEAR(out.velocity(), -ratio * in.velocity(), 1e-3 * std::abs(ratio * in.velocity()));
  EXPECT_NEAR(out.position(), -ratio * in.position(), 2e-3 * std::abs(ratio)) << "no drift";
  EXPECT_NEAR(model.find_joint("gear")->position(0), in.position(), 2e-3);
  EXPECT_NEAR(model.find_joint("gear")->position(1), out.position(), 2e-3);
}

TEST_P(Gearbox, InAFreeCaseItKeepsAllMomentum) {
  TestWorld world(weightless());
  Model& model = world.add(gearbox(true));
  world->apply_effort({model.find_joint("in"), 0.1, {}, {-1}});
  world->step(500);
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero();
  for (const auto& body : model.bodies) {
    if (body.get() == model.find_joint("gear")->shaft) continue;
    const Eigen::Matrix3d& R = body->rotation();
    momentum += body->mass() * body->velocity();
    spin += R * body->inertia_tensor() * R.transpose() * body->angular_velocity() +
            body->mass() * body->pose().p.cross(body->velocity());
  }
  EXPECT_LT(momentum.norm(), 1e-4);
  EXPECT_LT(spin.norm(), 1e-4);
  EXPECT_GT(model.find_joint("in")->velocity(), 0.05);
  EXPECT_NEAR(model.find_joint("out")->velocity(),
              -GetParam().ratio * model.find_joint("in")->velocity(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Layouts, Gearbox,
    testing::Values(Gears{"parallel", 0.5, {0, 0, 1}}, Gears{"parallel_step_up", 3.0, {0, 0, 1}},
                    Gears{"same_way", -1.0, {0, 0, 1}}, Gears{"opposed_axis", 2.0, {0, 0, -1}},
                    Gears{"bevel", 1.5, {1, 0, 0}}, Gears{"skew", -0.7, {0.5, 0.4, 0.3}}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(GearboxJoint, WheelsThatDoNotMoveAgainstTheReferenceAreRefused) {
  TestWorld world;
  ModelSpec model = make_on_world(JointType::kRevolute, {0, 0, 0}, {0, 0, 1});
  model.links.push_back(make_link("other", 1.0, {1, 1, 1}));
  model.joints.push_back(make_joint("gear", JointType::kGearbox, "bob", "other", {}, {0, 0, 1}));
  model.joints.back().gearbox_reference_body = "other";
  EXPECT_TRUE(contains(error_of([&] { world.add(model); }),
                       "gearbox 'gear': parent and child must move against the reference body"));
  model.joints.back().gearbox_reference_body = "nobody";
  EXPECT_TRUE(contains(error_of([&] { world.add(model); }), "names link 'nobody'"));
}

}  // namespace
}  // namespace trident::sim
