// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "quad_world.h"

namespace trident::sim {
namespace {

std::size_t port_count(TestWorld& world) {
  std::size_t count = 0;
  world->ports().for_each([&](const PortBase&) { ++count; });
  return count;
}

TEST(WorldLifecycle, NamesAndPortsAreFreeAfterDeletion) {
  TestWorld world;
  world.add(make_quad());
  EXPECT_GT(port_count(world), 10u);
  world->remove("quad");
  EXPECT_EQ(port_count(world), 0u);
  EXPECT_EQ(world->find_model("quad"), nullptr);
  EXPECT_NO_THROW(world.add(make_quad()));
  EXPECT_TRUE(contains(error_of([&] { world->remove("nobody"); }), "'nobody' does not exist"));
}

TEST(WorldLifecycle, AThousandSpawnsAndDeletionsLeaveNothing) {
  TestWorld world;
  world.add(make_ground());
  world.add(make_body("stays", BoxShape{{0.2, 0.2, 0.2}}, at(5, 0, 0.1)));
  const std::size_t ports = port_count(world);
  for (int i = 0; i < 1000; ++i) {
    QuadOptions options;
    options.T_world_model = at(0, 0, 1);
    world.add(make_quad(options));
    world->step();
    world->remove("quad");
  }
  EXPECT_EQ(port_count(world), ports);
  EXPECT_EQ(world->models().size(), 2u);
  EXPECT_TRUE(world.reports.empty());
}

TEST(WorldLifecycle, DeletionInContactLetsTheOthersContinue) {
  TestWorld world;
  world.add(make_ground());
  world.add(make_body("below", BoxShape{{0.2, 0.2, 0.2}}, at(0, 0, 0.1)));
  Model& above = world.add(make_body("above", BoxShape{{0.2, 0.2, 0.2}}, at(0, 0, 0.3)));
  world->step(50);
  world->remove("below");
  world->step(100);
  EXPECT_NEAR(above.T_world_model().p.z(), 0.1, 2e-3);
}

TEST(WorldLifecycle, DeletionDropsWrenchesAndEfforts) {
  TestWorld world;
  Model& body = world.add(make_body("m", SphereShape{0.1}, {}));
  world->apply_wrench({body.canonical_link(), {1, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0}, {-1}});
  world->remove("m");
  world->step(5);
  Model& again = world.add(make_body("m", SphereShape{0.1}, {}));
  world->step(5);
  EXPECT_EQ(again.bodies[0]->velocity().x(), 0.0);
}

TEST(WorldLifecycle, ARefusedModelLeavesTheWorldAsItWas) {
  TestWorld world;
  world.add(make_body("stays", SphereShape{0.1}, {}));
  ModelSpec bad = make_quad();
  bad.plugins.push_back(make_plugin("odometry2", "librotors_gazebo_odometry_plugin.so",
                                    {{"linkName", "no_such_link"}}));
  const std::string before = world->state_hash();
  const std::string error = error_of([&] { world.add(bad); });
  EXPECT_TRUE(contains(error, "<linkName> is 'no_such_link'"));
  EXPECT_TRUE(contains(error, "base_link, rotor_0"));
  EXPECT_EQ(world->state_hash(), before);
  EXPECT_EQ(port_count(world), 0u);
}

TEST(WorldLifecycle, SpawnRequestsNamePlaceAndNamespace) {
  TestWorld world;
  const std::string xml =
      "<sdf version='1.6'><model name='inside'><pose>9 9 9 0 0 0</pose><link name='l'/>"
      "<plugin name='o' filename='librotors_gazebo_odometry_plugin.so'><linkName>l</linkName>"
      "</plugin></model></sdf>";
  Model& model = world->spawn({"outside", xml, "", "/ns/", SE3::from_xyz_rpy({1, 2, 3}, 0, 0, 1)});
  EXPECT_EQ(model.name, "outside");
  EXPECT_TRUE(is_near(model.T_world_model(), SE3::from_xyz_rpy({1, 2, 3}, 0, 0, 1), 1e-12));
  EXPECT_NE(world->ports().find_out<OdometrySample>("ns/odometry"), nullptr);
  EXPECT_TRUE(contains(error_of([&] { world->spawn({"outside", xml, "", "", {}}); }), "'outside'"));
  EXPECT_TRUE(contains(error_of([&] {
                         world->spawn({"x", "<sdf", "request", "", {}});
                       }),
                       "request:"));
}

TEST(WorldLifecycle, TheSameModelTwiceInTwoNamespacesIsTwoVehicles) {
  TestWorld world;
  for (const char* name : {"UAV1", "UAV2"}) {
    QuadOptions options;
    options.name = options.robot_namespace = name;
    world.add(make_quad(options));
  }
  EXPECT_NE(world->ports().find_out<OdometrySample>("UAV1/odometry"), nullptr);
  EXPECT_NE(world->ports().find_out<OdometrySample>("UAV2/odometry"), nullptr);
}

TEST(WorldLifecycle, LinksAreFoundByScopedOrUniqueName) {
  TestWorld world;
  world.add(make_body("a", SphereShape{0.1}, {}));
  EXPECT_NE(world->find_link("link"), nullptr);
  world.add(make_body("b", SphereShape{0.1}, at(1, 0, 0)));
  EXPECT_EQ(world->find_link("link"), nullptr);
  EXPECT_EQ(world->find_link("b::link"), world->find_model("b")->canonical_link());
  EXPECT_EQ(world->find_link("c::link"), nullptr);
}

}  // namespace
}  // namespace trident::sim
