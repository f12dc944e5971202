// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "core/physics/rotor_axis.h"
#include "quad_world.h"

namespace trident::sim {
namespace {

/// Where the axis of rotor `number` points in the body after turning about x for a while.
Eigen::Vector3d axis_after_turning(int number, LoopTiming timing) {
  QuadWorld quad({}, timing);
  quad.settle({600, 600, 600, 600});
  quad->set_model_twist(*quad.quad, {0, 0, 0}, {1, 0, 0});
  for (int i = 0; i < 60; ++i) {
    quad->step();
    quad->set_model_twist(*quad.quad, {0, 0, 0}, quad.body().rotation() * Eigen::Vector3d(1, 0, 0));
  }
  return quad.quad->find_joint("rotor_" + std::to_string(number) + "_joint")->rotor_axis_body;
}

TEST(RotorAxis, LagsBehindATurnByTheErrorThatErpLeaves) {
  const Eigen::Vector3d cw = axis_after_turning(0, LoopTiming::kRotors);
  const Eigen::Vector3d ccw = axis_after_turning(1, LoopTiming::kRotors);
  // Error per step dt (w - ...) over erp: h w x r is short by (hs/2)^2 and off by hs/2 sideways.
  const double h = 0.01, s = 60.0, half = 0.5 * h * s, erp = 0.2;
  const double sideways = h * half / (1.0 + half * half) / erp;
  EXPECT_NEAR(ccw.x(), sideways, 0.3 * sideways);
  EXPECT_NEAR(cw.x(), -sideways, 0.3 * sideways);
  EXPECT_GT(ccw.y(), 0.0);  // the body's z turns to -y: a late axis is at +y
  EXPECT_NEAR(ccw.norm(), 1.0, 1e-12);
}

TEST(RotorAxis, IsRigidInDirectTiming) {
  EXPECT_EQ(axis_after_turning(1, LoopTiming::kDirect), Eigen::Vector3d(0, 0, 1));
}

TEST(RotorAxis, ComesBackWhenTheTurningEnds) {
  QuadWorld quad;
  quad.settle({600, 600, 600, 600});
  quad->set_model_twist(*quad.quad, {0, 0, 0}, {2, 0, 0});
  quad->step(20);
  const Joint& joint = *quad.quad->find_joint("rotor_1_joint");
  EXPECT_GT((joint.rotor_axis_body - joint.axis_body).norm(), 1e-3);
  for (int i = 0; i < 100; ++i) {
    quad->set_model_twist(*quad.quad, {0, 0, 0}, {0, 0, 0});
    quad->step();
  }
  EXPECT_LT((joint.rotor_axis_body - joint.axis_body).norm(), 1e-3);
  quad->reset();
  EXPECT_EQ(joint.rotor_axis_body, joint.axis_body);
}

TEST(RotorAxis, IsTheSameAloneAndNextToOthers) {
  const Eigen::Vector3d w_body(0.3, -1.2, 0.7);
  for (std::size_t count = 1; count <= 5; ++count) {
    std::vector<Joint> together(count), alone(count);
    std::vector<Joint*> joints;
    for (std::size_t i = 0; i < count; ++i) {
      const double tilt = 0.05 * static_cast<double>(i + 1);
      together[i].axis_body = Eigen::Vector3d(tilt, -2.0 * tilt, 1.0).normalized();
      together[i].rotor_axis_body = Eigen::Vector3d(-tilt, 0.5 * tilt, 1.0).normalized();
      together[i].rotor_velocity = i % 2 == 0 ? 61.0 : -43.0 - tilt;
      alone[i].axis_body = together[i].axis_body;
      alone[i].rotor_axis_body = together[i].rotor_axis_body;
      alone[i].rotor_velocity = together[i].rotor_velocity;
      joints.push_back(&together[i]);
      Joint* const one = &alone[i];
      advance_rotor_axes({&one, 1}, w_body, 0.2, 0.01);
    }
    const Eigen::Vector3d before = joints.front()->rotor_axis_body;
    advance_rotor_axes(joints, w_body, 0.2, 0.01);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(together[i].rotor_axis_body, alone[i].rotor_axis_body) << i << " of " << count;
    }
    EXPECT_GT((joints.front()->rotor_axis_body - before).norm(), 1e-3);
  }
}

}  // namespace
}  // namespace trident::sim
