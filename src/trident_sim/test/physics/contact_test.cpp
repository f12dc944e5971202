// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "models.h"
#include "scratch_folder.h"
#include "test_world.h"

namespace trident::sim {
namespace {

/// A closed box of half edge 0.1 m as STL text.
std::string box_stl() {
  const int faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                            {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  std::ostringstream out;
  out << "solid box\n";
  for (const auto& face : faces) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face) {
      out << "vertex " << ((corner & 1) ? 0.1 : -0.1) << " " << ((corner & 2) ? 0.1 : -0.1) << " "
          << ((corner & 4) ? 0.1 : -0.1) << "\n";
    }
    out << "endloop\nendfacet\n";
  }
  out << "endsolid box\n";
  return out.str();
}

struct Resting {
  const char* name;
  Shape shape;
  double half_height_m;
};
class RestsOn : public testing::TestWithParam<Resting> {};

void expect_at_rest(TestWorld& world, Model& model, double z) {
  world->step(300);
  EXPECT_NEAR(model.T_world_model().p.z(), z, 2e-3);
  EXPECT_LT(model.bodies[0]->velocity().norm(), 5e-3);
  EXPECT_LT(model.T_world_model().p.head<2>().norm(), 0.01);
}

TEST_P(RestsOn, ThePlane) {
  TestWorld world;
  world.add(make_ground());
  Model& model =
      world.add(make_body("m", GetParam().shape, at(0, 0, GetParam().half_height_m + 0.05)));
  expect_at_rest(world, model, GetParam().half_height_m);
}

TEST_P(RestsOn, AStaticBox) {
  TestWorld world;
  world.add(make_static("table", BoxShape{{2, 2, 1}}, at(0, 0, 0.5)));
  Model& model =
      world.add(make_body("m", GetParam().shape, at(0, 0, 1.0 + GetParam().half_height_m + 0.05)));
  expect_at_rest(world, model, 1.0 + GetParam().half_height_m);
}

TEST_P(RestsOn, AnotherBody) {
  TestWorld world;
  world.add(make_ground());
  Model& table = world.add(make_body("table", BoxShape{{1, 1, 0.4}}, at(0, 0, 0.2), 20.0));
  Model& model =
      world.add(make_body("m", GetParam().shape, at(0, 0, 0.4 + GetParam().half_height_m + 0.01)));
  expect_at_rest(world, model, 0.4 + GetParam().half_height_m);
  EXPECT_NEAR(table.T_world_model().p.z(), 0.2, 2e-3);
}
INSTANTIATE_TEST_SUITE_P(Shapes, RestsOn,
                         testing::Values(Resting{"box", BoxShape{{0.2, 0.2, 0.2}}, 0.1},
                                         Resting{"sphere", SphereShape{0.15}, 0.15},
                                         Resting{"cylinder", CylinderShape{0.1, 0.3}, 0.15}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Contact, ACapsuleRestsOnItsSide) {
  TestWorld world;
  world.add(make_ground());
  Model& model = world.add(make_body("m", CapsuleShape{0.1, 0.4},
                                     SE3::from_xyz_rpy({0, 0, 0.12}, std::acos(0.0), 0, 0)));
  expect_at_rest(world, model, 0.1);
}

TEST(Contact, AMeshRestsOnThePlaneAndCarriesABox) {
  const ScratchFolder folder;
  const std::string file = folder.write("box.stl", box_stl());
  TestWorld world;
  world.add(make_ground());
  Model& mesh = world.add(make_body("a", MeshShape{file, {2, 2, 1}}, at(0, 0, 0.12), 5.0));
  Model& box = world.add(make_body("b", BoxShape{{0.1, 0.1, 0.1}}, at(0, 0, 0.27), 0.2));
  expect_at_rest(world, mesh, 0.1);
  expect_at_rest(world, box, 0.25);
}

TEST(Contact, MeshesAreReadWithTheirFormatsAndRefusedWithTheirName) {
  const ScratchFolder folder;
  const std::string obj = folder.write(
      "tetra.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const std::string broken = folder.write("broken.stl", "solid but nothing follows");
  TestWorld world;
  EXPECT_NO_THROW(world.add(make_static("a", MeshShape{obj, {1, 1, 1}}, {})));
  const std::string error = error_of([&] {
    world.add(make_static("b", MeshShape{broken, {1, 1, 1}}, {}));
  });
  EXPECT_TRUE(contains(error, "b::link::collision"));
  EXPECT_TRUE(contains(error, "broken.stl"));
  EXPECT_EQ(world->find_model("b"), nullptr);
}

TEST(Contact, ATiltedPlaneCarriesToo) {
  Surface rough;
  rough.mu = rough.mu2 = 100.0;
  TestWorld world;
  ModelSpec slope = make_ground(rough);
  slope.T_world_model = SE3::from_xyz_rpy({0, 0, 0}, 0, 0.2, 0);
  world.add(std::move(slope));
  Model& box = world.add(make_body(
      "m", BoxShape{{0.2, 0.2, 0.2}},
      SE3::from_xyz_rpy({0.1 * std::sin(0.2), 0, 0.1 * std::cos(0.2)}, 0, 0.2, 0), 1.0, rough));
  world->step(200);
  EXPECT_LT(box.bodies[0]->velocity().norm(), 5e-3);
}

TEST(Contact, RestitutionRestoresItsPartOfTheSpeed) {
  Surface bouncy;
  bouncy.restitution = 0.6;
  bouncy.bounce_threshold_m_s = 0.01;
  TestWorld world(world_spec(0.001));
  world.add(make_ground(bouncy));
  Model& ball = world.add(make_body("m", SphereShape{0.1}, at(0, 0, 1.1), 1.0, bouncy));
  double down = 0.0, up = 0.0;
  while (world->step_count() < 1000) {
    world->step();
    down = std::min(down, ball.bodies[0]->velocity().z());
    up = std::max(up, ball.bodies[0]->velocity().z());
  }
  EXPECT_NEAR(down, -std::sqrt(2 * 9.8 * 1.0), 0.02);
  EXPECT_NEAR(up, -0.6 * down, 0.03);
}

TEST(Contact, BitmasksSeparate) {
  Surface one, two;
  one.collide_bitmask = 1;
  two.collide_bitmask = 2;
  TestWorld world;
  world.add(make_ground(one));
  Model& hit = world.add(make_body("a", SphereShape{0.1}, at(0, 0, 0.2), 1.0, one));
  Model& through = world.add(make_body("b", SphereShape{0.1}, at(2, 0, 0.2), 1.0, two));
  world->step(100);
  EXPECT_NEAR(hit.T_world_model().p.z(), 0.1, 2e-3);
  EXPECT_LT(through.T_world_model().p.z(), -1.0);
}

TEST(Contact, BodiesPushEachOtherAndKeepTheirMomentum) {
  WorldSpec spec = world_spec();
  spec.physics.gravity.setZero();
  TestWorld world(spec);
  Model& a = world.add(make_body("a", SphereShape{0.1}, at(-0.5, 0, 0), 2.0));
  Model& b = world.add(make_body("b", SphereShape{0.1}, at(0.5, 0, 0), 1.0));
  world->set_model_twist(a, {1, 0, 0}, {0, 0, 0});
  world->step(200);
  EXPECT_GT(b.bodies[0]->velocity().x(), 0.5);
  EXPECT_NEAR(2.0 * a.bodies[0]->velocity().x() + b.bodies[0]->velocity().x(), 2.0, 1e-9);
}

}  // namespace
}  // namespace trident::sim
