// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// A camera that is carried along with a model.
#include <gtest/gtest.h>

#include "models.h"
#include "test_world.h"

namespace trident::sim {
namespace {

SE3 at(double x, double y, double z) { return {Eigen::Quaterniond::Identity(), {x, y, z}}; }

ModelSpec eye(const std::string& followed, const std::string& offset) {
  ModelSpec spec;
  spec.name = "eye";
  spec.is_static = true;
  spec.T_world_model = at(9, 9, 9);
  spec.links = {make_link("link", 1.0, {1, 1, 1})};
  spec.plugins = {
      make_plugin("follow", "libtrident_follow.so", {{"followed", followed}, {"offset", offset}})};
  return spec;
}

Eigen::Vector3d place(TestWorld& world, const std::string& name) {
  return world->find_model(name)->T_world_model().p;
}

TEST(Follow, AStaticModelIsCarriedAlongAtItsOffset) {
  TestWorld world(weightless());
  Model& cart = world.add(make_body("cart", BoxShape{{1, 1, 1}}, at(1, 2, 3)));
  world.add(eye("cart", "0 -2 1"));
  world->set_model_twist(cart, {2, 0, 0}, {0, 0, 1});
  world->step(500);
  // Placed as the step begins: one step behind.
  EXPECT_NEAR(place(world, "eye").x(), 1.0 + 2.0 * 0.499, 1e-9);
  EXPECT_NEAR(place(world, "eye").y(), 0.0, 1e-9);
  EXPECT_NEAR(place(world, "eye").z(), 4.0, 1e-9);
  EXPECT_TRUE(world->find_model("eye")->T_world_model().R.isApprox(Eigen::Quaterniond::Identity()))
      << "it does not turn";
}

TEST(Follow, ItStaysWhileNobodyIsThereAndGoesBackWithAResetAndASnapshot) {
  TestWorld world(weightless());
  world.add(eye("cart", "0 0 1"));
  world->step(10);
  EXPECT_EQ(place(world, "eye"), Eigen::Vector3d(9, 9, 9));
  world.add(make_body("cart", BoxShape{{1, 1, 1}}, at(1, 2, 3)));
  world->step(10);
  EXPECT_TRUE(place(world, "eye").isApprox(Eigen::Vector3d(1, 2, 4)));
  const Snapshot snapshot = world->save_snapshot();
  world->reset();
  EXPECT_TRUE(place(world, "eye").isApprox(Eigen::Vector3d(9, 9, 9)));
  world->restore_snapshot(snapshot);
  EXPECT_TRUE(place(world, "eye").isApprox(Eigen::Vector3d(1, 2, 4)));
}

TEST(Follow, WhatCannotBeCarriedIsRefused) {
  TestWorld world(weightless());
  const auto refusal = [&](const std::string& followed, const std::string& offset) {
    return error_of([&] { world.add(eye(followed, offset)); });
  };
  EXPECT_NE(refusal("eye", "0 0 1").find("<followed>"), std::string::npos);
  EXPECT_NE(refusal("cart", "0 nan 1").find("<offset>"), std::string::npos);
  ModelSpec shaped = eye("cart", "0 0 1");
  shaped.links = make_static("wall", BoxShape{{1, 1, 1}}, {}).links;
  EXPECT_NE(error_of([&] { world.add(shaped); }).find("a static model with shapes"),
            std::string::npos);
}

}  // namespace
}  // namespace trident::sim
