// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "boat_world.h"
#include "marine/plugins/live_surroundings.h"
#include "marine/vessel/thruster.h"

namespace trident::sim {
namespace {

/// VRX' WAM-V, keels at z = 0 of its link, with further elements first.
ModelSpec make_vrx_wamv(ParamList first = {}) {
  const ParamList wamv{{"bodyName", "base_link"},
                       {"waterLevel", "0"},
                       {"waterDensity", "997.8"},
                       {"xDotU", "0"},
                       {"yDotV", "0"},
                       {"nDotR", "0"},
                       {"xU", "51.3"},
                       {"xUU", "72.4"},
                       {"yV", "40"},
                       {"zW", "500"},
                       {"kP", "50"},
                       {"mQ", "50"},
                       {"nR", "400"},
                       {"boatWidth", "2.4"},
                       {"boatLength", "4.9"},
                       {"hullRadius", "0.213"},
                       {"length_n", "2"},
                       {"wave_model", "ocean_waves"}};
  first.insert(first.end(), wamv.begin(), wamv.end());
  VesselParams params = shipped_vessel("wamv");
  params.center_of_gravity.setZero();
  return make_hull(params, "wamv", make_plugin("usv", "libusv_gazebo_dynamics_plugin.so", first));
}

class UsvEquation : public testing::TestWithParam<const char*> {};

TEST_P(UsvEquation, FloatsAtVrxDraftAndReachesTheSpeedOfItsDrag) {
  TestWorld world(ocean());
  Model& boat = world.add(make_vrx_wamv({{"legacy_vrx", GetParam()}}));
  world->step(3000);
  EXPECT_NEAR(boat.T_world_model().p.z(), -0.0796, 0.000796);
  const double force = 100.0;
  world->apply_wrench({boat.links[0].get(),
                       {force, 0, 0},
                       Eigen::Vector3d::Zero(),
                       Eigen::Vector3d::Zero(),
                       world->time(),
                       SimTime::from_seconds(-1.0)});
  world->step(6000);
  const double speed = (-51.3 + std::sqrt(51.3 * 51.3 + 4.0 * 72.4 * force)) / (2.0 * 72.4);
  EXPECT_NEAR(boat.links[0]->v_world_at(boat.T_world_model().p).x() / speed, 1.0, 5e-3);
}
INSTANTIATE_TEST_SUITE_P(Both, UsvEquation, testing::Values("false", "true"));

/// Added mass above the mass, as of VRX' larger vessels: fed back from differences it diverges.
TEST(UsvDynamics, OnlyVrxEquationDivergesWithLargeAddedMass) {
  const auto speed_after = [](const char* legacy) {
    TestWorld world(ocean());
    Model& boat = world.add(make_vrx_wamv({{"legacy_vrx", legacy}, {"yDotV", "300"}}));
    world->set_model_pose(boat, at(0, 0, -0.0796));
    world->set_model_twist(boat, {0.0, 0.1, 0.0}, Eigen::Vector3d::Zero());
    double fastest = 0.0;
    for (int i = 0; i < 30; ++i) {
      world->step();
      fastest = std::max(fastest, std::abs(boat.links[0]->body->velocity().y()));
    }
    return fastest;
  };
  EXPECT_LT(speed_after("false"), 0.11);
  EXPECT_GT(speed_after("true"), 1.0);
}

TEST(UsvDynamics, BadInputIsRefused) {
  const auto refusal = [](const char* key, const char* value) {
    TestWorld world(ocean());
    return error_of([&] { world.add(make_vrx_wamv({{key, value}})); });
  };
  EXPECT_TRUE(contains(refusal("xU", "-1"), "<xU> is '-1'"));
  EXPECT_TRUE(contains(refusal("yDotV", "nan"), "<yDotV> is 'nan'"));
  EXPECT_TRUE(contains(refusal("hullRadius", "0"), "<hullRadius> is '0'"));
  EXPECT_TRUE(contains(refusal("length_n", "0"), "<length_n> is '0'"));
  EXPECT_TRUE(contains(refusal("bodyName", "keel"), "a link of the model: base_link"));
}

using Elements = std::vector<std::pair<std::string, std::string>>;

ParamNode thruster_element(const std::string& side, const Elements& more) {
  ParamNode node{"thruster", "", {}, {}};
  Elements elements = more;
  elements.insert(elements.end(), {{"linkName", side + "_prop"},
                                   {"propJointName", side + "_prop_joint"},
                                   {"engineJointName", side + "_engine_joint"},
                                   {"cmdTopic", "thrusters/" + side + "_thrust_cmd"},
                                   {"angleTopic", "thrusters/" + side + "_thrust_angle"},
                                   {"enableAngle", "true"}});
  for (const auto& [key, value] : elements) node.children.push_back({key, value, {}, {}});
  return node;
}

/// VRX' WAM-V with two engines that turn and propellers on them.
ModelSpec make_vrx_wamv_with_engines(const Elements& of_thrusters = {}) {
  ModelSpec spec = make_vrx_wamv();
  PluginSpec thrust =
      make_plugin("thrust", "libusv_gazebo_thrust_plugin.so", {{"robotNamespace", "wamv"}});
  for (const auto& [side, y] :
       {std::pair{std::string("left"), 1.0}, {std::string("right"), -1.0}}) {
    const SE3 T = at(-2.4, y, 0.0796);
    spec.links.push_back(make_link(side + "_engine", 15.0, {0.9, 0.9, 0.9}, T));
    spec.links.push_back(make_link(side + "_prop", 0.5, {0.01, 0.01, 0.01}, T));
    JointSpec engine = make_joint(side + "_engine_joint", JointType::kRevolute, "base_link",
                                  side + "_engine", T, Eigen::Vector3d::UnitZ());
    engine.lower = -1.6;
    engine.upper = 1.6;
    spec.joints.push_back(engine);
    spec.joints.push_back(make_joint(side + "_prop_joint", JointType::kRevolute, side + "_engine",
                                     side + "_prop", T, Eigen::Vector3d::UnitX()));
    thrust.params.children.push_back(thruster_element(side, of_thrusters));
  }
  spec.plugins.push_back(thrust);
  return spec;
}

void steer(World& world, const char* what, double value) {
  for (const char* side : {"left", "right"}) {
    command(world, std::string("wamv/thrusters/") + side + what, value);
  }
}

TEST(UsvThrust, PushesAheadUntilCommandsStopComing) {
  TestWorld world(ocean());
  const Model& boat = world.add(make_vrx_wamv_with_engines({{"mappingType", "1"}}));
  for (int i = 0; i < 300; ++i) {
    steer(*world, "_thrust_cmd", 1.0);
    world->step(10);
  }
  const auto speed = [&] { return boat.links[0]->v_world_at(boat.T_world_model().p).x(); };
  const double force = 2.0 * vrx_glf_thrust(1.0);
  const double expected = (-51.3 + std::sqrt(51.3 * 51.3 + 4.0 * 72.4 * force)) / (2.0 * 72.4);
  EXPECT_NEAR(speed() / expected, 1.0, 0.02);
  world->step(1500);
  EXPECT_LT(speed(), 0.2 * expected);
}

TEST(UsvThrust, AnglesTurnTheEnginesAndTheBoat) {
  TestWorld world(ocean());
  const Model& boat = world.add(make_vrx_wamv_with_engines());
  auto* const joints = world->ports().find_out<JointStateSample>("wamv/joint_states");
  ASSERT_NE(joints, nullptr);
  joints->add_listener();
  steer(*world, "_thrust_angle", 0.5);
  for (int i = 0; i < 50; ++i) {
    steer(*world, "_thrust_cmd", 0.3);
    world->step(10);
  }
  EXPECT_NEAR(boat.find_joint("left_engine_joint")->position(), 0.5, 0.05);
  ASSERT_EQ(joints->value.names.size(), 4U);
  EXPECT_NEAR(joints->value.positions[0], 0.5, 0.05);
  // Propellers turn, the faster the longer in vain against nothing, but not without a limit.
  EXPECT_EQ(joints->value.names[1], "left_prop_joint");
  EXPECT_GT(joints->value.velocities[1], 10.0);
  EXPECT_LT(joints->value.velocities[1], 110.0);
  // Pushed to port at the stern: the bow goes to starboard.
  EXPECT_LT(boat.T_world_model().rpy().z(), -0.2);
}

TEST(UsvThrust, ContinuesFromASnapshot) {
  TestWorld world(ocean());
  world.add(make_vrx_wamv_with_engines());
  const auto run = [&] {
    for (int i = 0; i < 20; ++i) {
      steer(*world, "_thrust_cmd", 0.05 * i);
      steer(*world, "_thrust_angle", 0.02 * i);
      world->step(10);
    }
    return world->state_hash();
  };
  run();
  const Snapshot snapshot = world->save_snapshot();
  const std::string hash = run();
  world->restore_snapshot(snapshot);
  EXPECT_EQ(run(), hash);
}

TEST(UsvThrust, BadInputIsRefused) {
  const auto refusal = [](const Elements& elements) {
    TestWorld world(ocean());
    return error_of([&] { world.add(make_vrx_wamv_with_engines(elements)); });
  };
  EXPECT_TRUE(contains(refusal({{"linkName", "screw"}}),
                       "model 'wamv' plugin 'thrust' <thruster[1]>: <linkName> is 'screw'"));
  EXPECT_TRUE(contains(refusal({{"engineJointName", "pod"}}), "<engineJointName> is 'pod'"));
  EXPECT_TRUE(contains(refusal({{"maxForceFwd", "-5"}}), "<maxForceFwd> is '-5'"));
  EXPECT_TRUE(contains(refusal({{"mappingType", "2"}}), "<mappingType> is '2'"));
  TestWorld world(ocean());
  ModelSpec spec = make_vrx_wamv();
  spec.plugins.push_back(make_plugin("thrust", "libusv_gazebo_thrust_plugin.so", {}));
  EXPECT_TRUE(contains(error_of([&] { world.add(spec); }), "<thruster> is '', expected"));
}

PluginSpec vrx_waves(const ParamList& wave) {
  PluginSpec plugin = make_plugin("waves", "libWavefieldModelPlugin.so", {{"static", "false"}});
  ParamNode node{"wave", "", {}, {}};
  for (const auto& [key, value] : wave) node.children.push_back({key, value, {}, {}});
  plugin.params.children.push_back(std::move(node));
  return plugin;
}

TEST(VrxWaveField, WavesAreThoseOfVrx) {
  TestWorld world(ocean({vrx_waves({{"model", "PMS"},
                                    {"period", "5"},
                                    {"number", "3"},
                                    {"scale", "1.5"},
                                    {"gain", "0.1"},
                                    {"direction", "1 0"},
                                    {"angle", "0.4"},
                                    {"tau", "2"}})}));
  const Environment& sea = *dynamic_cast<const LiveSurroundings&>(*find_sea(*world)).environment;
  const auto& waves = sea.waves().components();
  ASSERT_EQ(waves.size(), 3U);
  EXPECT_NEAR(waves[0].amplitude_m, 5.3e-3, 1e-4);
  EXPECT_NEAR(waves[1].amplitude_m, 27.3e-3, 1e-4);
  EXPECT_NEAR(waves[2].amplitude_m, 17.9e-3, 1e-4);
  EXPECT_EQ(sea.waves().elevation_m({0, 0}, 0.0), 0.0);  // they grow with tau
}

TEST(VrxWaveField, BadInputIsRefused) {
  const auto refusal = [](const ParamList& wave) {
    return error_of([&] { TestWorld world(ocean({vrx_waves(wave)})); });
  };
  EXPECT_TRUE(contains(refusal({{"model", "Stokes"}}), "<model> is 'Stokes', expected PMS or CWR"));
  EXPECT_TRUE(contains(refusal({{"number", "4"}}), "<number> is '4'"));
  EXPECT_TRUE(contains(refusal({{"model", "CWR"}, {"amplitude", "-1"}}), "<amplitude> is '-1'"));
  EXPECT_TRUE(contains(refusal({{"direction", "0 0"}}), "<direction> is '0 0'"));
  EXPECT_TRUE(contains(refusal({{"hight", "1"}}), "<hight> is '1', expected no such element"));
}

}  // namespace
}  // namespace trident::sim
