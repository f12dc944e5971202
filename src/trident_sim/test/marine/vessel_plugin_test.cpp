// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "boat_world.h"
#include "marine/vessel/thruster.h"
#include "plugin_conformance.h"
#include "scratch_folder.h"
#include "trident_base/angle.h"

namespace trident::sim {
namespace {

class EveryBoat : public testing::TestWithParam<const char*> {};

TEST_P(EveryBoat, FloatsAtItsDraftAndStays) {
  const VesselParams params = shipped_vessel(GetParam());
  const Hull hull(params.hull, params.water_density, kSeaGravity);
  const StaticPose rest = hull.rest(params.mass, params.rigid_body().center_of_gravity);
  const double draft = params.hull.sections.front().draft;
  EXPECT_LT(std::abs(rest.z_m), 0.01 * draft);

  TestWorld world(ocean());
  Model& boat = world.add(make_boat(GetParam()));
  world->set_model_pose(boat, at(0, 0, 0.2 * draft));
  world->step(6000);
  const SE3 settled = boat.T_world_model();
  EXPECT_NEAR(settled.p.z(), rest.z_m, 0.01 * draft);
  EXPECT_NEAR(settled.rpy().y(), rest.pitch_rad, 1e-4);
  world->step(6000);
  EXPECT_TRUE(is_near(boat.T_world_model(), settled, 1e-4));
}

/// The world's boat moves as the core's does.
TEST_P(EveryBoat, MovesAsTheCore) {
  const VesselParams params = shipped_vessel(GetParam());
  StandaloneVessel core(params, Restoring::kHull, kSeaGravity);
  TestWorld world(ocean());
  Model& boat = world.add(make_boat(GetParam()));
  Thruster left(params.thrusters[0]), right(params.thrusters[1]);
  const double full = params.thrusters[0].max_command;
  for (int i = 0; i < 2000; ++i) {
    if (i == 10) {
      command(*world, "boat/thrusters/left_thrust_cmd", 0.7 * full);
      left.command(0.7 * full);
    }
    if (i == 500) {
      command(*world, "boat/thrusters/right_thrust_cmd", -0.4 * full);
      right.command(-0.4 * full);
    }
    left.step(0.01);
    right.step(0.01);
    core.step(left.wrench() + right.wrench(), 0.01);
    world->step();
  }
  EXPECT_GT(core.T_world_co().p.head<2>().norm(), 1.0);
  EXPECT_TRUE(is_near(boat.T_world_model(), core.T_world_co(), 1e-6));
}

INSTANTIATE_TEST_SUITE_P(All, EveryBoat,
                         testing::Values("otter", "wamv", "heron", "small_catamaran"));

double terminal_speed(const std::string& vessel, double command) {
  TestWorld world(ocean());
  const Model& boat = world.add(make_boat(vessel));
  thrust(*world, command);
  world->step(12000);
  return boat.links[0]->v_world_at(boat.T_world_model().p).x();
}

TEST(VesselPlugin, TerminalSurgeSpeedIsWhereDragEqualsThrust) {
  EXPECT_NEAR(terminal_speed("otter", 60.0) / (2.0 * 0.01108 * 3600.0 / 77.554432), 1.0, 5e-3);
  const double force = 2.0 * vrx_glf_thrust(0.5);
  const double speed = (-51.3 + std::sqrt(51.3 * 51.3 + 4.0 * 72.4 * force)) / (2.0 * 72.4);
  EXPECT_NEAR(terminal_speed("wamv", 0.5) / speed, 1.0, 5e-3);
}

TEST(VesselPlugin, HeaveDecaysWithThePeriodOfTheWaterplane) {
  const VesselParams params = shipped_vessel("wamv");
  const Hull hull(params.hull, params.water_density, kSeaGravity);
  const double stiffness = params.water_density * kSeaGravity * hull.hydrostatics().waterplane_m2;
  const double mass = params.mass + params.added_mass[2];
  const double rate = params.linear_damping[2] / (2.0 * mass);
  const double expected = 2.0 * kPi / std::sqrt(stiffness / mass - rate * rate);

  TestWorld world(ocean());
  Model& boat = world.add(make_boat("wamv"));
  const double rest = hull.rest(params.mass, params.rigid_body().center_of_gravity).z_m;
  world->set_model_pose(boat, at(0, 0, rest + 0.005));
  std::vector<double> crossings;
  double before = 0.005;
  for (int i = 0; i < 300; ++i) {
    world->step();
    const double z = boat.T_world_model().p.z() - rest;
    if (before > 0.0 && z <= 0.0) crossings.push_back(0.01 * (i + before / (before - z)));
    before = z;
  }
  ASSERT_GE(crossings.size(), 4U);
  EXPECT_NEAR((crossings[3] - crossings[0]) / 3.0 / expected, 1.0, 0.01);
}

PluginSpec rough_sea() {
  return make_sea({{"waves",
                    {{"spectrum", "jonswap"},
                     {"significant_height", "0.4"},
                     {"peak_period", "3"},
                     {"components", "20"}}},
                   {"current", {{"kind", "shear"}, {"speed", "0.3"}, {"shear", "0.01"}}}});
}

/// Two boats that are driven about in waves.
class Regatta {
 public:
  Regatta() : world_(ocean({rough_sea()}), seeded()) {
    world_.add(make_boat("otter", "a"));
    ModelSpec b = make_boat("wamv", "b");
    b.T_world_model = at(10, 0, 0);
    world_.add(std::move(b));
  }
  void run(int from, int to) {
    for (int i = from; i < to; ++i) {
      if (i % 50 == 0) thrust(*world_, 60.0 * std::sin(0.01 * i), "a");
      if (i % 70 == 0) thrust(*world_, std::cos(0.01 * i), "b");
      if (i % 90 == 0) command(*world_, "b/thrusters/left_thrust_angle", 0.5 * std::sin(0.02 * i));
      world_->step();
    }
  }
  World& world() { return *world_; }

 private:
  static WorldOptions seeded() {
    WorldOptions options;
    options.seed = 11;
    return options;
  }
  TestWorld world_;
};

TEST(VesselPlugin, RunsAreEqualToTheBitAndContinueFromASnapshot) {
  Regatta first, second;
  first.run(0, 1000);
  second.run(0, 410);
  const Snapshot snapshot = second.world().save_snapshot();
  second.run(410, 1000);
  const std::string hash = first.world().state_hash();
  EXPECT_EQ(second.world().state_hash(), hash);
  second.world().restore_snapshot(snapshot);
  EXPECT_NE(second.world().state_hash(), hash);
  second.run(410, 1000);
  EXPECT_EQ(second.world().state_hash(), hash);
}

TEST(VesselPlugin, ResetStartsAgain) {
  Regatta boats;
  boats.run(0, 300);
  const std::string hash = boats.world().state_hash();
  boats.world().reset();
  boats.run(0, 300);
  EXPECT_EQ(boats.world().state_hash(), hash);
}

TEST(VesselPlugin, UniformCurrentCarriesTheSamePathAlong) {
  TestWorld still(ocean()),
      carried(ocean({make_sea(
          {{"current", {{"kind", "uniform"}, {"speed", "0.5"}, {"direction", "0.7"}}}})}));
  const Eigen::Vector3d v(0.5 * std::cos(0.7), 0.5 * std::sin(0.7), 0.0);
  const Model& a = still.add(make_boat("otter"));
  Model& b = carried.add(make_boat("otter"));
  carried->set_model_twist(b, v, Eigen::Vector3d::Zero());
  for (int i = 0; i < 6000; ++i) {
    for (TestWorld* world : {&still, &carried}) {
      if (i % 100 == 0) {
        command(**world, "boat/thrusters/left_thrust_cmd", 60.0 + 30.0 * std::sin(0.003 * i));
        command(**world, "boat/thrusters/right_thrust_cmd", 60.0);
      }
      (*world)->step();
    }
  }
  EXPECT_GT(a.T_world_model().p.head<2>().norm(), 5.0);
  EXPECT_TRUE(is_near(b.T_world_model().p, a.T_world_model().p + 60.0 * v, 1e-3));
}

TEST(VesselPlugin, CommandsThatAreNotFiniteAreRefusedAndOthersClamped) {
  TestWorld world(ocean());
  world.add(make_boat("otter"));
  auto* const thrust_port = world->ports().find_out<ScalarSample>("boat/thrusters/left_thrust");
  ASSERT_NE(thrust_port, nullptr);
  thrust_port->add_listener();
  const std::string topic = "boat/thrusters/left_thrust_cmd";
  command(*world, topic, 50.0);
  world->step(300);
  EXPECT_NEAR(thrust_port->value.value, 0.01108 * 2500.0, 1e-6);
  command(*world, topic, std::numeric_limits<double>::quiet_NaN());
  command(*world, topic, std::numeric_limits<double>::infinity());
  world->step(300);
  EXPECT_NEAR(thrust_port->value.value, 0.01108 * 2500.0, 1e-6);
  command(*world, topic, 500.0);
  world->step(300);
  EXPECT_NEAR(thrust_port->value.value, 0.01108 * 103.93 * 103.93, 0.1);

  const auto& entries = world->diagnostics().entries();
  const std::string subject = "model 'boat' plugin 'vessel': command of thruster 'left' ";
  ASSERT_EQ(entries.count(subject + "refused"), 1U);
  EXPECT_EQ(entries.at(subject + "refused").count, 2U);
  EXPECT_TRUE(contains(entries.at(subject + "refused").newest.message,
                       "is refused, the last good one stays; legal is [-101.74, 103.93]"));
  ASSERT_EQ(entries.count(subject + "clamped"), 1U);
  EXPECT_EQ(world.report_count(Severity::kError, "nan is refused"), 1U);
}

TEST(VesselPlugin, ThrusterStopsWhenCommandsStopComing) {
  TestWorld world(ocean());
  ModelSpec spec = make_boat("wamv");
  spec.plugins[0].params.children.push_back({"cmdTimeout", "0.5", {}, {}});
  world.add(std::move(spec));
  auto* const port = world->ports().find_out<ScalarSample>("boat/thrusters/left_thrust");
  port->add_listener();
  command(*world, "boat/thrusters/left_thrust_cmd", 1.0);
  world->step(50);
  EXPECT_GT(port->value.value, 100.0);
  world->step(10);
  EXPECT_EQ(port->value.value, 0.0);
}

TEST(VesselPlugin, WorldWithoutSeaIsReportedOnce) {
  TestWorld world(ocean());
  world.add(make_boat("otter", "a"));
  ModelSpec b = make_boat("otter", "b");
  b.T_world_model = at(5, 0, 0);
  world.add(std::move(b));
  world->step(10);
  EXPECT_EQ(world.report_count(Severity::kWarning, "has no sea"), 1U);
}

std::string refusal(const ModelSpec& spec) {
  TestWorld world(ocean());
  return error_of([&] { world.add(spec); });
}

TEST(VesselPlugin, BadInputIsOneClearError) {
  ModelSpec spec = make_boat("otter");
  spec.plugins[0].params.children[1].text = "config/vessels/raft.yaml";
  EXPECT_TRUE(contains(refusal(spec),
                       "model 'boat' plugin 'vessel': <vessel> is "
                       "'config/vessels/raft.yaml', expected a file; searched"));

  spec = make_boat("otter");
  spec.links[0].inertial.mass_kg = 70.0;
  EXPECT_TRUE(contains(refusal(spec), "the link's mass is 70 kg, the vessel's is 80 kg"));
  spec = make_boat("otter");
  spec.links[0].inertial.T_link_com.p.z() = 0.0;
  EXPECT_TRUE(contains(refusal(spec), "the link's centre of gravity, from CO, is "));
  spec = make_boat("otter");
  spec.links[0].inertial.inertia_com(1, 1) *= 1.05;
  EXPECT_TRUE(contains(refusal(spec), "the link's inertia is "));
  spec = make_boat("otter");
  spec.is_static = true;
  EXPECT_TRUE(contains(refusal(spec), "expected a link that forces move"));

  const ScratchFolder folder;
  spec = make_boat("otter");
  spec.plugins[0].params.children[1].text =
      folder.write("raft.yaml", "name: raft\nmass: -3\ninertia: [1, 1, 1]\n");
  EXPECT_TRUE(contains(refusal(spec), "raft.yaml:2"));
}

TEST(VesselPlugin, Conforms) {
  const std::string file = TRIDENT_REPOSITORY "/src/trident_sim/test/marine/quad_boat.yaml";
  expect_plugin_conforms({"libtrident_vessel.so",
                          {{"robotNamespace", "ns"}, {"bodyName", "base_link"}, {"vessel", file}},
                          {"bodyName", "vessel"},
                          {"cmdTimeout", "xyzOffset"}});
}

}  // namespace
}  // namespace trident::sim
