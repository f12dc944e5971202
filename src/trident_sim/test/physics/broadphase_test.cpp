// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>

#include "models.h"
#include "test_world.h"
#include "trident_base/random_stream.h"

namespace trident::sim {
namespace {

constexpr int kBodies = 60;

/// The i-th sphere of scene `scene`: somewhere in a 3 m cube, 5 to 40 cm.
ModelSpec random_sphere(int scene, int i) {
  const RandomStream stream(11, "scene" + std::to_string(scene));
  const auto sample = [&](std::uint32_t channel, double lo, double hi) {
    return lo + (hi - lo) * stream.uniform(static_cast<std::uint64_t>(i), channel);
  };
  const double radius = sample(0, 0.05, 0.4);
  ModelSpec model = make_body("m" + std::to_string(i), SphereShape{radius},
                              at(sample(1, -1.5, 1.5), sample(2, -1.5, 1.5), sample(3, -1.5, 1.5)));
  model.links[0].gravity = false;
  return model;
}

double radius_of(const ModelSpec& model) {
  return std::get<SphereShape>(model.links[0].collisions[0].shape).radius;
}

class Broadphase : public testing::TestWithParam<int> {};

TEST_P(Broadphase, FindsExactlyTheBodiesThatTouch) {
  TestWorld world;
  std::vector<ModelSpec> specs;
  for (int i = 0; i < kBodies; ++i) {
    specs.push_back(random_sphere(GetParam(), i));
    world.add(specs.back());
  }
  std::set<std::string> touching;
  for (const ModelSpec& a : specs) {
    for (const ModelSpec& b : specs) {
      const double distance = (a.T_world_model.p - b.T_world_model.p).norm();
      if (a.name != b.name && distance < radius_of(a) + radius_of(b)) touching.insert(a.name);
    }
  }
  world->step();
  std::set<std::string> found;
  for (const auto& [name, model] : world->models()) {
    if (model->bodies[0]->has_contact()) found.insert(name);
  }
  EXPECT_EQ(found, touching);
  EXPECT_GT(touching.size(), 5u);
  EXPECT_LT(touching.size(), static_cast<std::size_t>(kBodies));
}
INSTANTIATE_TEST_SUITE_P(Scenes, Broadphase, testing::Range(0, 10));

TEST(Collision, BodiesOfOneModelPassThroughEachOtherUnlessItSelfCollides) {
  for (const bool self_collide : {false, true}) {
    TestWorld world;
    ModelSpec spec = make_body("m", SphereShape{0.2}, {});
    spec.links[0].gravity = false;
    spec.links.push_back(spec.links[0]);
    spec.links[1].name = "other";
    spec.links[1].T_model_link.p = {0.3, 0, 0};
    spec.self_collide = self_collide;
    Model& model = world.add(std::move(spec));
    ASSERT_EQ(model.bodies.size(), 2u);
    world->step();
    EXPECT_EQ(model.bodies[0]->has_contact(), self_collide);
  }
}

TEST(Collision, JointedNeighborsDoNotCollideEvenThen) {
  TestWorld world;
  ModelSpec spec = make_body("m", SphereShape{0.2}, {});
  spec.links.push_back(spec.links[0]);
  spec.links[1].name = "other";
  spec.links[1].T_model_link.p = {0.3, 0, 0};
  spec.self_collide = true;
  spec.joints.push_back(
      make_joint("j", JointType::kRevolute, "link", "other", at(0.15, 0, 0), {0, 0, 1}));
  Model& model = world.add(std::move(spec));
  world->step();
  EXPECT_FALSE(model.bodies[0]->has_contact());
}

TEST(Collision, StaticModelsDoNotMoveAndDoNotCollideWithEachOther) {
  TestWorld world;
  world.add(make_static("a", BoxShape{{1, 1, 1}}, at(0, 0, 5)));
  world.add(make_static("b", BoxShape{{1, 1, 1}}, at(0.2, 0, 5)));
  world->step(50);
  EXPECT_TRUE(is_near(world->find_model("a")->T_world_model(), at(0, 0, 5), 0.0));
  EXPECT_TRUE(is_near(world->find_model("b")->T_world_model(), at(0.2, 0, 5), 0.0));
}

TEST(Collision, AStaticBodyFarFromTheOriginIsHit) {
  TestWorld world;
  world.add(
      make_static("table", BoxShape{{1, 1, 1}}, SE3::from_xyz_rpy({100, -50, 10}, 0, 0, 0.7)));
  Model& ball = world.add(make_body("ball", SphereShape{0.1}, at(100, -50, 10.65)));
  world->step(200);
  EXPECT_NEAR(ball.T_world_model().p.z(), 10.6, 2e-3);
}

}  // namespace
}  // namespace trident::sim
