// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "models.h"
#include "test_world.h"

namespace trident::sim {
namespace {

constexpr double kMass = 2.0;  ///< of the box [kg]

SensorSpec contact_sensor(const std::vector<std::string>& collisions, double rate_hz = 0.0) {
  SensorSpec sensor;
  sensor.name = "bumper";
  sensor.type = "contact";
  sensor.update_rate_hz = rate_hz;
  ParamNode contact{"contact", "", {}, {}};
  for (const std::string& name : collisions)
    contact.children.push_back({"collision", name, {}, {}});
  sensor.params = {"sensor", "", {}, {contact}};
  sensor.plugins.push_back(make_plugin("p", "libgazebo_ros_bumper.so",
                                       {{"robotNamespace", "r"}, {"bumperTopicName", "bumps"}}));
  return sensor;
}

ModelSpec box_with(const SensorSpec& sensor, const SE3& T_world_model) {
  ModelSpec box = make_body("box", BoxShape{{0.4, 0.4, 0.4}}, T_world_model, kMass);
  box.links[0].sensors.push_back(sensor);
  return box;
}

std::string collision_name() { return make_collision(SphereShape{1.0}).name; }

OutPort<ContactsSample>& listen(TestWorld& world) {
  auto* port = world->ports().find_out<ContactsSample>("r/bumps");
  port->add_listener();
  return *port;
}

TEST(Bumper, ABoxAtRestFeelsItsWeightAtItsCorners) {
  TestWorld world(world_spec(0.002));
  world.add(make_ground());
  world.add(box_with(contact_sensor({collision_name()}), at(1.0, 2.0, 0.2)));
  auto& bumps = listen(world);
  world->step(1000);
  const ContactsSample& value = bumps.value;
  EXPECT_EQ(bumps.count(), 1000u);
  EXPECT_EQ(value.stamp, world->time());
  EXPECT_EQ(value.frame, "world");
  ASSERT_EQ(value.touches.size(), 1u);
  const TouchSample& touch = value.touches[0];
  EXPECT_EQ(touch.collision1, "box::link::" + collision_name());
  EXPECT_TRUE(contains(touch.collision2, "ground"));
  ASSERT_GE(touch.depths.size(), 3u);
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < touch.depths.size(); ++i) {
    force += touch.forces[i];
    torque += touch.torques[i];
    EXPECT_TRUE(is_near(touch.normals[i], {0, 0, 1}, 1e-6));
    EXPECT_NEAR(touch.positions[i].z(), 0.0, 2e-3);
    EXPECT_NEAR(std::abs(touch.positions[i].x() - 1.0), 0.2, 1e-3);
    EXPECT_NEAR(std::abs(touch.positions[i].y() - 2.0), 0.2, 1e-3);
    EXPECT_GE(touch.depths[i], -1e-9);
    EXPECT_LT(touch.depths[i], 2e-3);
  }
  EXPECT_TRUE(is_near(force, {0, 0, kMass * 9.8}, 1e-3 * kMass * 9.8));
  EXPECT_TRUE(is_near(torque, {0, 0, 0}, 1e-3)) << "about the centre of mass";
}

TEST(Bumper, ReportsAtItsRateThatNothingTouches) {
  TestWorld world(weightless());
  world.add(box_with(contact_sensor({collision_name()}, 50.0), at(0, 0, 1)));
  auto& bumps = listen(world);
  world->step(1000);
  EXPECT_EQ(bumps.count(), 50u);
  EXPECT_TRUE(bumps.value.touches.empty());
}

TEST(Bumper, OfAPlateIsPressedByWhatLiesOnIt) {
  TestWorld world(world_spec(0.002));
  ModelSpec plate = make_static("plate", BoxShape{{2.0, 2.0, 0.2}}, at(0, 0, -0.1));
  plate.links[0].sensors.push_back(contact_sensor({plate.links[0].collisions[0].name}));
  world.add(plate);
  world.add(make_body("box", BoxShape{{0.4, 0.4, 0.4}}, at(0, 0, 0.2), kMass));
  auto& bumps = listen(world);
  world->step(1000);
  ASSERT_EQ(bumps.value.touches.size(), 1u);
  const TouchSample& touch = bumps.value.touches[0];
  EXPECT_TRUE(contains(touch.collision1, "plate::"));
  EXPECT_TRUE(contains(touch.collision2, "box::"));
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& one : touch.forces) force += one;
  EXPECT_TRUE(is_near(force, {0, 0, -kMass * 9.8}, 1e-3 * kMass * 9.8));
  EXPECT_TRUE(is_near(touch.normals.at(0), {0, 0, -1}, 1e-6));
}

TEST(Bumper, ListeningDoesNotChangeWhatHappensAndNobodyCollectsWithoutIt) {
  std::string hashes[2];
  for (const bool is_heard : {false, true}) {
    TestWorld world(world_spec(0.002));
    world.add(make_ground());
    SE3 T = SE3::from_xyz_rpy({0, 0, 0.6}, 0.3, 0.2, 0.1);
    world.add(box_with(contact_sensor({collision_name()}), T));
    if (is_heard) listen(world);
    bool collects = false;
    for (int i = 0; i < 500; ++i) {
      world->step();
      collects = collects || !world->contacts().empty();
    }
    EXPECT_EQ(collects, is_heard);
    hashes[is_heard ? 1 : 0] = world->state_hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Bumper, BadSensorsAreRefusedByName) {
  const auto refusal = [](const SensorSpec& sensor) {
    TestWorld world;
    return error_of([&] { world.add(box_with(sensor, {})); });
  };
  EXPECT_TRUE(contains(refusal(contact_sensor({})), "<collision> is missing"));
  const std::string error = refusal(contact_sensor({"elbow"}));
  EXPECT_TRUE(contains(error, "'elbow'"));
  EXPECT_TRUE(contains(error, "expected a collision of link 'link': " + collision_name()));
}

}  // namespace
}  // namespace trident::sim
