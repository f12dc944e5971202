// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <ode/ode.h>

#include "models.h"
#include "test_world.h"

namespace trident::sim {
namespace {

/// The same body stepped by ODE itself, with the gyroscopic torque given from outside.
class OdeBody {
 public:
  explicit OdeBody(const Body& body) : world_(dWorldCreate()), body_(dBodyCreate(world_)) {
    dMass mass;
    const Eigen::Matrix3d& I = body.inertia_tensor();
    dMassSetParameters(&mass, body.mass(), 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2),
                       I(1, 2));
    dBodySetMass(body_, &mass);
    dBodySetGyroscopicMode(body_, 0);
    const SE3& T = body.pose();
    const dQuaternion q = {T.R.w(), T.R.x(), T.R.y(), T.R.z()};
    dBodySetPosition(body_, T.p.x(), T.p.y(), T.p.z());
    dBodySetQuaternion(body_, q);
    dBodySetLinearVel(body_, body.velocity().x(), body.velocity().y(), body.velocity().z());
    dBodySetAngularVel(body_, body.angular_velocity().x(), body.angular_velocity().y(),
                       body.angular_velocity().z());
  }
  ~OdeBody() { dWorldDestroy(world_); }
  OdeBody(const OdeBody&) = delete;
  OdeBody& operator=(const OdeBody&) = delete;

  void step(const Body& like, const Eigen::Vector3d& gravity, double dt_s) {
    const Eigen::Vector3d w_world = v3(dBodyGetAngularVel(body_));
    const Eigen::Quaterniond R = pose().R;
    const Eigen::Vector3d w = R.conjugate() * w_world;
    const Eigen::Vector3d torque = R * -w.cross(like.inertia_tensor() * w);
    const Eigen::Vector3d force = like.mass() * gravity;
    dBodyAddForce(body_, force.x(), force.y(), force.z());
    dBodyAddTorque(body_, torque.x(), torque.y(), torque.z());
    dWorldStep(world_, dt_s);
  }
  SE3 pose() const {
    const dReal* q = dBodyGetQuaternion(body_);
    return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]), v3(dBodyGetPosition(body_))};
  }

 private:
  static Eigen::Vector3d v3(const dReal* v) { return {v[0], v[1], v[2]}; }
  dWorldID world_;
  dBodyID body_;
};

TEST(FreeBody, MovesAsOdeWouldMoveIt) {
  TestWorld world;
  ModelSpec spec = make_body("m", SphereShape{0.1}, SE3::from_xyz_rpy({1, 2, 3}, 0.3, -0.4, 2.0));
  spec.links[0].inertial.inertia_com << 0.02, 0.001, -0.002, 0.001, 0.03, 0.003, -0.002, 0.003,
      0.04;
  Model& model = world.add(std::move(spec));
  world->set_model_twist(model, {1, -2, 3}, {4, -3, 2});
  const Body& body = *model.bodies[0];
  OdeBody ode(body);
  for (int i = 0; i < 500; ++i) {
    ode.step(body, world->physics().gravity, 0.01);
    world->step();
    ASSERT_TRUE(is_near(body.pose().p, ode.pose().p, 1e-10));
    ASSERT_LT((body.pose().R.coeffs() - ode.pose().R.coeffs()).norm(), 1e-10);
  }
}

TEST(FreeBody, FallsWithGravityUnlessItsLinkHasNone) {
  TestWorld world;
  ModelSpec floating = make_body("floating", SphereShape{0.1}, at(5, 0, 0));
  floating.links[0].gravity = false;
  Model& a = world.add(make_body("falling", SphereShape{0.1}, {}));
  Model& b = world.add(std::move(floating));
  world->step(100);
  EXPECT_NEAR(a.bodies[0]->velocity().z(), -9.8, 1e-9);
  EXPECT_EQ(b.bodies[0]->velocity(), Eigen::Vector3d(0, 0, 0));
}

TEST(FreeBody, VelocityDecays) {
  TestWorld world;
  ModelSpec spec = make_body("m", SphereShape{0.1}, {});
  spec.links[0].gravity = false;
  spec.links[0].linear_damping = 0.5;
  spec.links[0].angular_damping = 2.0;
  Model& model = world.add(std::move(spec));
  world->set_model_twist(model, {1, 0, 0}, {0, 0, 1});
  world->step(100);
  EXPECT_NEAR(model.bodies[0]->velocity().x(), std::exp(-0.5), 0.005);
  EXPECT_NEAR(model.bodies[0]->angular_velocity().z(), std::exp(-2.0), 0.01);
}

TEST(FreeBody, AKinematicBodyKeepsItsVelocity) {
  TestWorld world;
  ModelSpec spec = make_body("m", BoxShape{{1, 1, 1}}, at(0, 0, 3));
  spec.links[0].kinematic = true;
  Model& model = world.add(std::move(spec));
  world.add(make_body("rider", BoxShape{{0.2, 0.2, 0.2}}, at(0, 0, 3.6)));
  world->set_model_twist(model, {0.1, 0, 0}, {0, 0, 0});
  world->step(200);
  EXPECT_TRUE(is_near(model.T_world_model().p, {0.2, 0, 3}, 1e-9));
  // Friction carries the rider along.
  EXPECT_NEAR(world->find_model("rider")->bodies[0]->velocity().x(), 0.1, 0.01);
}

TEST(FreeBody, ConservesMomentumWhenTheStepIsSmall) {
  WorldSpec spec = world_spec(0.0005);
  spec.physics.gravity.setZero();
  TestWorld world(spec);
  ModelSpec box = make_body("m", SphereShape{0.1}, {});
  box.links[0].inertial.inertia_com = Eigen::Vector3d(0.01, 0.02, 0.03).asDiagonal();
  Model& model = world.add(std::move(box));
  world->set_model_twist(model, {0, 0, 0}, {0.1, 5, 0.1});
  const Body& body = *model.bodies[0];
  const auto momentum = [&body] {
    return Eigen::Vector3d(body.rotation() * body.inertia_tensor() * body.rotation().transpose() *
                           body.angular_velocity());
  };
  const Eigen::Vector3d before = momentum();
  world->step(2000);
  EXPECT_TRUE(is_near(momentum(), before, 0.01 * before.norm()));
}

}  // namespace
}  // namespace trident::sim
