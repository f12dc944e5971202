// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "golden_data.h"
#include "golden_world.h"
#include "lee_quad.h"
#include "test_world.h"
#include "trident_control_sim/lee_plugin.h"

namespace trident::sim {
namespace {

using Prepare = void (*)(TestWorld&);

void fly_quads(TestWorld& world) {
  control::register_control_plugins(world.registry);
  world.add(make_ground());
  for (int i = 0; i < 2; ++i) {
    QuadOptions options;
    options.name = options.robot_namespace = "quad" + std::to_string(i);
    options.T_world_model = at(2.0 * i, 0, 0.1);
    const LeeQuad quad(1.05, options);
    ModelSpec spec = quad.model();
    spec.plugins.push_back(
        make_plugin("imu", "librotors_gazebo_imu_plugin.so",
                    {{"robotNamespace", options.robot_namespace}, {"linkName", "base_link"}}));
    world.add(std::move(spec));
    control::TrajectorySample sample;
    sample.points.resize(2);
    sample.points[0].point.p_world = {2.0 * i + 1.0, 1.0, 2.0};
    sample.points[1].point.p_world = {2.0 * i, -1.0, 1.0};
    sample.points[1].time_from_start = SimTime::from_seconds(2.5);
    world->ports()
        .find_in<control::TrajectorySample>(options.robot_namespace + "/command/trajectory")
        ->write(sample);
    world->ports().find_out<ImuSample>(options.robot_namespace + "/imu")->add_listener();
  }
}

void pile_up(TestWorld& world) {
  world.add(make_ground());
  for (int i = 0; i < 12; ++i) {
    const SE3 T =
        SE3::from_xyz_rpy({0.05 * (i % 3), 0.04 * (i % 2), 0.2 + 0.25 * i}, 0.1 * i, 0.2, 0);
    world.add(make_body("box" + std::to_string(i), BoxShape{{0.2, 0.2, 0.2}}, T));
  }
}

/// A driven, sprung, geared and screwed arm that hits the ground.
void move_joints(TestWorld& world) {
  world.add(make_ground());
  ModelSpec model;
  model.name = "arm";
  model.T_world_model = at(0, 0, 0.6);
  const Eigen::Vector3d inertia(0.02, 0.03, 0.04), z(0, 0, 1), y(0, 1, 0);
  const char* names[] = {"base", "a", "b", "c", "d"};
  for (int i = 0; i < 5; ++i) {
    model.links.push_back(make_link(names[i], 1.0, inertia, at(0.2 * i, 0, 0)));
    model.links.back().collisions.push_back(make_collision(SphereShape{0.08}));
  }
  model.joints.push_back(make_joint("turn", JointType::kRevolute, "base", "a", {}, z));
  model.joints.push_back(make_joint("fold", JointType::kUniversal, "a", "b", at(0.3, 0, 0), y));
  model.joints.back().axis2.axis_model = z;
  model.joints.back().axis2.spring_stiffness = 2.0;
  model.joints.push_back(make_joint("screw", JointType::kScrew, "b", "c", at(0.5, 0, 0), y));
  model.joints.back().screw_pitch_m = 0.2;
  model.joints.push_back(make_joint("wrist", JointType::kRevolute, "base", "d", at(0.7, 0, 0), y));
  model.joints.push_back(make_joint("gear", JointType::kGearbox, "a", "d", {}, z));
  model.joints.back().axis2.axis_model = y;
  model.joints.back().gearbox_ratio = 0.5;
  model.joints.back().gearbox_reference_body = "base";
  Model& arm = world.add(std::move(model));
  DriveSpec drive;
  drive.gains.p = 2.0;
  drive.gains.i = 1.0;
  drive.gains.d = 0.1;
  drive.target = 5.0;
  world->add_drive(*arm.find_joint("turn"), drive);
  drive.mode = DriveMode::kVelocity;
  world->add_drive(*arm.find_joint("screw"), drive);
  world->apply_effort(
      {arm.find_joint("fold"), 0.3, SimTime::from_seconds(0.5), SimTime::from_seconds(1.0), 1});
}

struct Case {
  const char* name;
  Prepare prepare;
  LoopTiming timing;
  const char* solver;
};
void PrintTo(const Case& value, std::ostream* out) { *out << value.name; }

/// One world, from its beginning.
class Flight {
 public:
  explicit Flight(const Case& what) : world_(spec(what), options(what)) { what.prepare(world_); }
  World* operator->() { return &*world_; }
  /// The hash, and what the sensors have measured.
  std::string everything() {
    std::string text = world_->state_hash();
    world_->ports().for_each([&text](const PortBase& port) {
      const auto* imu = dynamic_cast<const OutPort<ImuSample>*>(&port);
      if (imu != nullptr) text += " " + std::to_string(imu->value.a_imu.sum());
      text += " " + std::to_string(port.count());
    });
    return text;
  }

 private:
  static WorldSpec spec(const Case& what) {
    WorldSpec spec = world_spec();
    spec.physics.solver = what.solver;
    return spec;
  }
  static WorldOptions options(const Case& what) {
    WorldOptions options;
    options.timing = what.timing;
    options.seed = 7;
    return options;
  }
  TestWorld world_;
};

class SnapshotOf : public testing::TestWithParam<Case> {
 protected:
  static constexpr std::uint64_t kSteps = 200;
};

TEST_P(SnapshotOf, ContinuesAsIfItHadNotStopped) {
  Flight straight(GetParam());
  straight->step(2 * kSteps);
  const std::string expected = straight.everything();

  Flight run(GetParam());
  run->step(kSteps);
  const Snapshot snapshot = run->save_snapshot();
  EXPECT_EQ(snapshot.step_count(), kSteps);
  const std::string then = run.everything();
  run->step(kSteps + 17);
  EXPECT_NE(run.everything(), expected);
  for (int times = 0; times < 2; ++times) {  // a snapshot is good for any number of restores
    run->restore_snapshot(snapshot);
    EXPECT_EQ(run.everything(), then);
    run->step(kSteps);
    EXPECT_EQ(run.everything(), expected);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Worlds, SnapshotOf,
    testing::Values(Case{"rotors_timing", fly_quads, LoopTiming::kRotors, "world"},
                    Case{"direct_timing", fly_quads, LoopTiming::kDirect, "world"},
                    Case{"pile", pile_up, LoopTiming::kDirect, "world"},
                    Case{"quick_pile", pile_up, LoopTiming::kDirect, "quick"},
                    Case{"joints", move_joints, LoopTiming::kDirect, "world"}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(SnapshotOfFireflies, FlyingWithTheirControllersContinueAsIfTheyHadNotStopped) {
  TRIDENT_NEEDS_GOLDEN();
  GoldenWorld world(golden_folder() + "/params/basic.world");
  for (const char* name : {"UAV1", "UAV2"}) {
    world.add_firefly(name, at(0, name[3] == '1' ? 0.0 : 2.0, 0.08), true);
    world.command(name, {0.5, name[3] == '1' ? 0.0 : 2.0, 1.0}, 0.3);
  }
  world->step(300);
  const Snapshot snapshot = world->save_snapshot();
  world->step(300);
  const std::string expected = world->state_hash();
  world.command("UAV1", {2, 0, 2}, 0.0);
  world->step(50);
  world->restore_snapshot(snapshot);
  world->step(300);
  EXPECT_EQ(world->state_hash(), expected);
  EXPECT_GT(world->find_model("UAV1")->T_world_model().p.z(), 0.8);
}

TEST(Snapshot, BringsBackPhysicsWrenchesAndDrives) {
  TestWorld world(world_spec(0.01));
  Model& model = world.add(make_body("m", SphereShape{0.1}, at(0, 0, 5)));
  world->apply_wrench({model.links[0].get(), {0, 0, 20}, {0, 0, 0}, {0, 0, 0}, {}, {-1}});
  const Snapshot snapshot = world->save_snapshot();
  world->step(10);
  const std::string expected = world->state_hash();
  PhysicsSpec physics = world->physics();
  physics.max_step_size_s = 0.002;
  physics.gravity.setZero();
  world->set_physics(physics);
  world->clear_wrenches(*model.links[0]);
  world->step(3);
  world->restore_snapshot(snapshot);
  EXPECT_EQ(world->dt(), SimTime::from_seconds(0.01));
  world->step(10);
  EXPECT_EQ(world->state_hash(), expected);
}

TEST(Snapshot, DrivesThatCameOrWentAreAsTheyWere) {
  TestWorld world;
  ModelSpec spec = make_body("m", SphereShape{0.1}, at(0, 0, 5));
  for (const char* name : {"a", "b"}) {
    spec.links.push_back(make_link(name, 1.0, {0.1, 0.1, 0.1}, at(0.5, 0, 0)));
    spec.joints.push_back(make_joint(name, JointType::kRevolute, "link", name, {}, {0, 0, 1}));
  }
  Model& model = world.add(std::move(spec));
  Joint &a = *model.find_joint("a"), &b = *model.find_joint("b");
  world->add_drive(a, {DriveMode::kEffort, {}, 1.0});
  const Snapshot snapshot = world->save_snapshot();
  world->remove_drive(a);
  world->add_drive(b, {DriveMode::kEffort, {}, 2.0});
  world->restore_snapshot(snapshot);
  ASSERT_NE(world->find_drive(a), nullptr);
  EXPECT_DOUBLE_EQ(world->find_drive(a)->target(), 1.0);
  EXPECT_EQ(world->find_drive(b), nullptr);
  JointDrive* const drive = world->find_drive(a);
  drive->set_target(9.0);
  world->restore_snapshot(snapshot);
  EXPECT_EQ(world->find_drive(a), drive);
  EXPECT_DOUBLE_EQ(drive->target(), 1.0);
}

TEST(Snapshot, OfOtherModelsOrAnotherWorldIsRefusedAndNothingChanges) {
  TestWorld world, other;
  world.add(make_body("m", SphereShape{0.1}, at(0, 0, 5)));
  const Snapshot snapshot = world->save_snapshot();
  EXPECT_TRUE(
      contains(error_of([&] { other->restore_snapshot(snapshot); }), "is of another world"));
  world.add(make_body("n", SphereShape{0.1}, at(3, 0, 5)));
  world->step(5);
  const std::string hash = world->state_hash();
  EXPECT_TRUE(contains(error_of([&] { world->restore_snapshot(snapshot); }), "model 'n'"));
  EXPECT_EQ(world->state_hash(), hash);
  world->remove("n");
  world->restore_snapshot(snapshot);
  world->remove("m");
  EXPECT_TRUE(contains(error_of([&] { world->restore_snapshot(snapshot); }),
                       "model 'm' (spawn 1) is gone"));
  world.add(make_body("m", SphereShape{0.1}, at(0, 0, 5)));
  EXPECT_TRUE(contains(error_of([&] { world->restore_snapshot(snapshot); }),
                       "model 'm' (spawn 1) is gone"));
}

}  // namespace
}  // namespace trident::sim
