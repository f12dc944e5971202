// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "quad_world.h"
#include "trident_base/random_stream.h"

namespace trident::sim {
namespace {

/// Boxes that fall on each other and on a slope, and two quads that fly into them.
std::vector<ModelSpec> scene() {
  std::vector<ModelSpec> models;
  ModelSpec slope = make_ground();
  slope.T_world_model = SE3::from_xyz_rpy({0, 0, 0}, 0.1, 0.15, 0);
  models.push_back(std::move(slope));
  const RandomStream stream(5, "scene");
  for (std::uint64_t i = 0; i < 20; ++i) {
    const auto u = [&](std::uint32_t channel) { return 2.0 * stream.uniform(i, channel) - 1.0; };
    models.push_back(
        make_body("box" + std::to_string(i), BoxShape{{0.2, 0.2, 0.2}},
                  SE3::from_xyz_rpy({0.4 * u(0), 0.4 * u(1), 1.0 + 0.6 * u(2)}, u(3), u(4), u(5)),
                  1.0 + 0.5 * u(6)));
  }
  for (const char* name : {"UAV1", "UAV2"}) {
    QuadOptions options;
    options.name = options.robot_namespace = name;
    options.T_world_model = SE3::from_xyz_rpy({name[3] == '1' ? -1.0 : 1.0, 0, 1}, 0, 0, 0.3);
    options.rotor_drag = 1e-4;
    ModelSpec quad = make_quad(options);
    quad.links[0].collisions.push_back(make_collision(BoxShape{{0.2, 0.2, 0.1}}));
    models.push_back(std::move(quad));
  }
  return models;
}

class Determinism : public testing::TestWithParam<const char*> {
 protected:
  WorldSpec spec() const {
    WorldSpec spec = world_spec();
    spec.physics.solver = GetParam();
    return spec;
  }
  static void spawn(TestWorld& world, const std::vector<ModelSpec>& models) {
    for (const ModelSpec& model : models) world.add(model);
  }
  /// Hashes every 20 steps of a flight in which the quads are driven into the pile.
  static std::vector<std::string> run(TestWorld& world) {
    std::vector<std::string> hashes;
    for (int i = 0; i < 15; ++i) {
      for (const char* name : {"UAV1/command/motor_speed", "UAV2/command/motor_speed"}) {
        ActuatorCommand command;
        command.stamp = world->time();
        const std::vector<double> speeds{480.0 + i, 470, 480, 470};
        command.angular_velocities.assign({speeds.data(), 4});
        world->ports().find_in<ActuatorCommand>(name)->write(command);
      }
      world->step(20);
      hashes.push_back(world->state_hash());
    }
    return hashes;
  }
};

TEST_P(Determinism, TwoRunsAreEqual) {
  TestWorld a(spec()), b(spec());
  spawn(a, scene());
  spawn(b, scene());
  const auto first = run(a);
  EXPECT_EQ(first, run(b));
  EXPECT_NE(first[0], first[1]);
}

TEST_P(Determinism, TheOrderOfSpawningDoesNotMatter) {
  TestWorld a(spec()), b(spec());
  std::vector<ModelSpec> models = scene();
  spawn(a, models);
  std::rotate(models.begin(), models.begin() + 7, models.end());
  std::reverse(models.begin(), models.begin() + 9);
  spawn(b, models);
  EXPECT_EQ(run(a), run(b));
}

TEST_P(Determinism, AnIslandDoesNotFeelAnother) {
  TestWorld alone(spec()), both(spec());
  std::vector<ModelSpec> models = scene();
  models.resize(21);  // without the quads
  spawn(alone, models);
  spawn(both, models);
  for (std::size_t i = 1; i < models.size(); ++i) {
    models[i].name = "a_far_" + models[i].name;
    models[i].T_world_model.p.y() += 50.0;
    models[i].T_world_model.p.z() += 50.0 * std::tan(0.1);
    both.add(models[i]);
  }
  alone->step(100);
  both->step(100);
  for (const auto& [name, model] : alone->models()) {
    if (model->is_static) continue;
    const Body& a = *model->bodies[0];
    const Body& b = *both->find_model(name)->bodies[0];
    EXPECT_EQ(a.pose().p, b.pose().p) << name;
    EXPECT_EQ(a.angular_velocity(), b.angular_velocity()) << name;
  }
}

TEST_P(Determinism, WhoListensDoesNotMatter) {
  TestWorld a(spec()), b(spec());
  spawn(a, scene());
  spawn(b, scene());
  b->ports().for_each([&](const PortBase& port) {
    if (port.direction() == PortDirection::kOut) {
      b->ports().find(port.name(), PortDirection::kOut)->add_listener();
    }
  });
  EXPECT_EQ(run(a), run(b));
}

TEST_P(Determinism, AResetRepeatsTheFirstRun) {
  TestWorld world(spec());
  spawn(world, scene());
  const std::string start = world->state_hash();
  const auto first = run(world);
  world->reset();
  EXPECT_EQ(world->time(), SimTime{0});
  EXPECT_EQ(world->state_hash(), start);
  EXPECT_EQ(run(world), first);
}

TEST_P(Determinism, AnotherWorldInTheProcessDoesNotMatter) {
  TestWorld a(spec()), b(spec()), other(spec());
  spawn(a, scene());
  spawn(b, scene());
  const auto first = run(a);
  spawn(other, scene());
  other->step(77);
  EXPECT_EQ(run(b), first);
}

TEST_P(Determinism, StepsMayBeTakenOneByOneOrTogether) {
  TestWorld a(spec()), b(spec());
  spawn(a, scene());
  spawn(b, scene());
  a->step(100);
  for (int i = 0; i < 100; ++i) b->step();
  EXPECT_EQ(a->state_hash(), b->state_hash());
}
INSTANTIATE_TEST_SUITE_P(Solvers, Determinism, testing::Values("quick", "world"));

TEST(ResetModels, LeavesTimeRunning) {
  QuadWorld quad;
  quad.command_all(600.0);
  quad->step(50);
  quad->reset_models();
  EXPECT_EQ(quad->time(), SimTime::from_seconds(0.5));
  EXPECT_TRUE(is_near(quad.quad->T_world_model(), SE3::identity(), 0.0));
  EXPECT_EQ(quad.rotor(1), 0.0);
  quad->step(3);
  EXPECT_EQ(quad.rotor(1), 0.0);  // the old command is forgotten
}

TEST(StateHash, SeesEveryPartOfTheState) {
  QuadWorld quad;
  const std::string start = quad->state_hash();
  EXPECT_EQ(start.size(), 64u);
  quad->set_model_pose(*quad.quad, at(1e-15, 0, 0));
  const std::string moved = quad->state_hash();
  EXPECT_NE(moved, start);
  quad->set_model_twist(*quad.quad, {0, 0, 1e-15}, {0, 0, 0});
  const std::string flying = quad->state_hash();
  EXPECT_NE(flying, moved);
  quad.quad->find_joint("rotor_2_joint")->set_velocity(1e-12);
  EXPECT_NE(quad->state_hash(), flying);
}

TEST(StateHash, CountsStepsAndNames) {
  TestWorld a, b;
  a.add(make_static("m", SphereShape{0.1}, {}));
  b.add(make_static("n", SphereShape{0.1}, {}));
  EXPECT_NE(a->state_hash(), b->state_hash());
  const std::string before = a->state_hash();
  a->step();
  EXPECT_NE(a->state_hash(), before);
}

}  // namespace
}  // namespace trident::sim
