// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "boat_world.h"
#include "marine/vessel/uuv_thruster.h"
#include "trident_base/angle.h"
#include "trident_sim/commands.h"
#include "trident_sim/thruster_setup.h"

namespace trident::sim {
namespace {

double settled_vehicle(UuvThruster thruster, double input, double dt_s, int steps) {
  for (int i = 0; i < steps; ++i) thruster.step(input, dt_s);
  return thruster.state_value();
}

TEST(UuvThruster, DynamicsAreTheirEquations) {
  UuvThrusterParams params;
  EXPECT_EQ(settled_vehicle(UuvThruster(params), 7.0, 0.01, 1), 7.0);
  params.dynamics = UuvDynamics::kFirstOrder;
  params.time_constant_s = 0.05;
  EXPECT_NEAR(settled_vehicle(UuvThruster(params), 1.0, 0.01, 5), 1.0 - std::exp(-1.0), 1e-12);
  params.dynamics = UuvDynamics::kYoerger;
  params.alpha = 0.5;
  params.beta = 8.0;
  EXPECT_NEAR(settled_vehicle(UuvThruster(params), 4.0, 0.01, 2000), std::sqrt(64.0), 1e-9);
  // s_dot = beta u - alpha s^2 is solved by tanh.
  EXPECT_NEAR(settled_vehicle(UuvThruster(params), 4.0, 1e-5, 10000), 8.0 * std::tanh(4.0 * 0.1),
              1e-3);
  params.dynamics = UuvDynamics::kBessa;
  params.Jmsp = 0.02;
  params.Kv1 = 0.3;
  params.Kv2 = 0.1;
  params.Kt = 0.2;
  params.Rm = 0.5;
  const double state = settled_vehicle(UuvThruster(params), -10.0, 0.01, 2000);
  EXPECT_NEAR(-0.3 * state + 0.1 * state * state, 0.2 * 10.0 / 0.5, 1e-9);
  params.alpha = 1e9;  // as stiff as can be, at a step as long as can be
  params.dynamics = UuvDynamics::kYoerger;
  EXPECT_TRUE(std::isfinite(settled_vehicle(UuvThruster(params), 1e3, 0.1, 100)));
}

TEST(UuvThruster, ConversionsAreTheirEquations) {
  UuvThrusterParams params;
  params.rotor_constant = 0.02;
  EXPECT_NEAR(UuvThruster(params).thrust_at(-30.0), -18.0, 1e-12);
  params.conversion = UuvConversion::kBessa;
  params.rotor_constant_left = 0.01;
  params.rotor_constant_right = 0.03;
  params.delta_left = -4.0;
  params.delta_right = 9.0;
  const UuvThruster bessa(params);
  EXPECT_EQ(bessa.thrust_at(2.9), 0.0);
  EXPECT_EQ(bessa.thrust_at(-1.9), 0.0);
  EXPECT_NEAR(bessa.thrust_at(10.0), 0.03 * 91.0, 1e-12);
  EXPECT_NEAR(bessa.thrust_at(-10.0), -0.01 * 96.0, 1e-12);
}

const ParamList kHeronThruster{{"linkName", "propeller"}, {"jointName", "propeller_joint"},
                               {"thrusterID", "0"},       {"gain", "1"},
                               {"clampMin", "-1"},        {"clampMax", "1"},
                               {"thrustMin", "-35"},      {"thrustMax", "35"}};

ParamNode element(const std::string& name, const ParamList& children) {
  ParamNode node{name, "", {}, {}};
  for (const auto& [key, value] : children) node.children.push_back({key, value, {}, {}});
  return node;
}

PluginSpec heron_thruster(const ParamList& dynamics, const ParamList& conversion,
                          const ParamList& more = {}) {
  ParamList elements = more;
  elements.insert(elements.end(), kHeronThruster.begin(), kHeronThruster.end());
  PluginSpec plugin = make_plugin("thruster", "libuuv_thruster_ros_plugin.so", elements);
  plugin.params.children.push_back(element("dynamics", dynamics));
  plugin.params.children.push_back(element("conversion", conversion));
  return plugin;
}
const ParamList kFirstOrder{{"type", "FirstOrder"}, {"timeConstant", "0.05"}};
const ParamList kHeronCurve{
    {"type", "LinearInterp"},
    {"inputValues", "-1 -0.8 -0.6 -0.4 -0.2 0 0.2 0.4 0.6 0.8 1"},
    {"outputValues", "-19.88 -16.52 -12.6 -5.6 -1.4 0 2.24 9.52 21.28 28 33.6"}};

/// Heron's hull by uuv_simulator's plugin, with one propeller amidships.
ModelSpec make_heron(const PluginSpec& thruster, const ParamList& link_first = {},
                     const ParamList& hydrodynamics_first = {}) {
  ModelSpec spec;
  spec.name = "heron";
  spec.links.push_back(make_link("base_link", 28.0, {10, 10, 10}));
  spec.links.push_back(make_link("propeller", 1e-3, {1e-6, 1e-6, 1e-6}));
  spec.joints.push_back(make_joint("propeller_joint", JointType::kRevolute, "base_link",
                                   "propeller", SE3::identity(), Eigen::Vector3d::UnitX()));
  ParamList link = link_first;
  link.insert(link.end(), {{"neutrally_buoyant", "0"},
                           {"volume", "0.13"},
                           {"center_of_buoyancy", "0 0 0"},
                           {"metacentric_width", "0.1"},
                           {"metacentric_length", "0.1"},
                           {"submerged_height", "0.02"}});
  ParamNode node = element("link", link);
  node.attributes.emplace_back("name", "base_link");
  node.children.push_back(element("box", {{"width", "1"}, {"length", "1.35"}, {"height", "0.32"}}));
  ParamList model = hydrodynamics_first;
  model.insert(model.end(), {{"type", "fossen"},
                             {"added_mass",
                              "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 "
                              "0 0 0"},
                             {"linear_damping", "-16.44998712 -15.79776044 -100 -13 -13 -6"},
                             {"quadratic_damping", "-2.942 -2.7617212 -10 -5 -5 -5"}});
  node.children.push_back(element("hydrodynamic_model", model));
  PluginSpec hull =
      make_plugin("hull", "libuuv_underwater_object_ros_plugin.so", {{"fluid_density", "1028"}});
  hull.params.children.push_back(node);
  spec.plugins = {hull, thruster};
  return spec;
}

TEST(UuvPlugins, HeronFloatsRollsAndRunsByItsFigures) {
  TestWorld world(ocean({make_sea({})}));
  Model& boat = world.add(make_heron(heron_thruster(kFirstOrder, kHeronCurve)));
  auto* const thrust = world->ports().find_out<StampedNumber>("heron/thrusters/0/thrust");
  auto* const wrench = world->ports().find_out<WrenchSample>("heron/thrusters/0/thrust_wrench");
  ASSERT_NE(thrust, nullptr);
  ASSERT_NE(wrench, nullptr);
  thrust->add_listener();
  wrench->add_listener();
  // Half the box's height above the draft; period of roll 2 pi sqrt(I / (m g GM)).
  world->set_model_pose(boat, SE3::from_xyz_rpy({0, 0, 0.14}, 0.02, 0, 0));
  const double omega = std::sqrt(28.0 * kSeaGravity * 0.1 / 10.0);
  while (boat.T_world_model().rpy().x() > 0.0) world->step();
  // Damping 13 N m s delays the first crossing: cot of the phase is the damping ratio.
  const double ratio = 13.0 / (2.0 * 10.0 * omega), damped = omega * std::sqrt(1.0 - ratio * ratio);
  EXPECT_NEAR(world->time().seconds(), (kPi / 2 + std::asin(ratio)) / damped, 0.03);
  world->step(2000);
  EXPECT_NEAR(boat.T_world_model().p.z(), 0.14, 1e-4);
  command(*world, "heron/thrusters/0/input", 0.7);
  world->step(4000);
  EXPECT_NEAR(thrust->value.value, 24.64, 1e-9);
  EXPECT_NEAR(wrench->value.force.x(), 24.64, 1e-9);
  EXPECT_EQ(wrench->value.frame, "propeller");
  const double a = 2.942, b = 16.44998712;
  const double speed = (-b + std::sqrt(b * b + 4.0 * a * 24.64)) / (2.0 * a);
  EXPECT_NEAR(boat.links[0]->v_world_at(boat.T_world_model().p).x() / speed, 1.0, 1e-3);
  EXPECT_NEAR(boat.find_joint("propeller_joint")->velocity(), 0.7, 1e-6);
  EXPECT_GT(boat.find_joint("propeller_joint")->position(), 20.0);
}

TEST(UuvPlugins, CurrentOfTheSeaCarriesIt) {
  TestWorld world(ocean({make_sea({{"current", {{"kind", "uniform"}, {"speed", "0.5"}}}})}));
  Model& boat = world.add(make_heron(heron_thruster(kFirstOrder, kHeronCurve)));
  world->set_model_pose(boat, at(0, 0, 0.14));
  world->step(3000);
  EXPECT_NEAR(boat.links[0]->body->velocity().x(), 0.5, 1e-3);
}

TEST(UuvPlugins, InputsThatAreNotLegalAreRefusedOrCut) {
  TestWorld world(ocean({make_sea({})}));
  world.add(make_heron(heron_thruster(kFirstOrder, kHeronCurve)));
  const std::string topic = "heron/thrusters/0/input";
  for (const double value : {0.4, std::numeric_limits<double>::quiet_NaN(), 3.0}) {
    command(*world, topic, value);
    world->step(100);
  }
  std::string reported;
  for (const auto& [name, entry] : world->diagnostics().entries()) {
    reported += entry.newest.message + "\n";
  }
  EXPECT_TRUE(
      contains(reported, topic + ": nan is refused, the last good one stays; legal is [-1, 1]"))
      << reported;
  EXPECT_TRUE(contains(reported, topic + ": 3 is cut to the nearest; legal is [-1, 1]"))
      << reported;
}

TEST(UuvPlugins, AThrusterIsSwitchedOffAndWeakened) {
  TestWorld world(ocean({make_sea({})}));
  world.add(make_heron(heron_thruster(kFirstOrder, kHeronCurve, {{"thrust_efficiency", "0.9"}})));
  PortBoard& ports = world->ports();
  auto* const thrust = ports.find_out<StampedNumber>("heron/thrusters/0/thrust");
  auto* const is_on = ports.find_out<FlagSample>("heron/thrusters/0/is_on");
  auto* const change = ports.find_in<ThrusterChange>("heron/thrusters/0/setup");
  auto* const setup = ports.find_out<ThrusterSetup>("heron/thrusters/0/setup");
  ASSERT_TRUE(thrust != nullptr && is_on != nullptr && change != nullptr && setup != nullptr);
  thrust->add_listener();
  is_on->add_listener();
  EXPECT_EQ(setup->value.conversion, "LinearInterp");
  EXPECT_EQ(setup->value.outputs.size(), 11U);
  const auto after = [&](const ThrusterChange& what) {
    change->write(what);
    command(*world, "heron/thrusters/0/input", 0.7);
    world->step(100);
    return thrust->value.value;
  };
  EXPECT_NEAR(after({}), 0.9 * 24.64, 1e-6);
  const Snapshot snapshot = world->save_snapshot();
  EXPECT_NEAR(after({{}, {}, 0.5, {}}), 0.5 * 24.64, 1e-6);
  // Half of the state, 0.35: halfway between 2.24 N and 9.52 N, and then as far again.
  EXPECT_NEAR(after({{}, {}, 1.0, 0.5}), 2.24 + 0.75 * (9.52 - 2.24), 1e-6);
  EXPECT_NEAR(after({{}, {}, 1.5, std::nan("")}), 2.24 + 0.75 * (9.52 - 2.24), 1e-6);
  EXPECT_NEAR(after({{}, false, {}, {}}), 0.0, 1e-6);
  EXPECT_FALSE(is_on->value.value);
  world->restore_snapshot(snapshot);
  EXPECT_NEAR(after({}), 0.9 * 24.64, 1e-6);
  after({{}, false, {}, {}});
  world->reset();
  EXPECT_NEAR(after({}), 0.9 * 24.64, 1e-6);
  EXPECT_TRUE(setup->value.is_on);
}

TEST(UuvPlugins, BadInputIsOneClearError) {
  const auto refusal = [](const PluginSpec& thruster, const ParamList& link = {},
                          const ParamList& model = {}) {
    TestWorld world(ocean());
    return error_of([&] { world.add(make_heron(thruster, link, model)); });
  };
  const PluginSpec good = heron_thruster(kFirstOrder, kHeronCurve);
  EXPECT_TRUE(contains(refusal(heron_thruster({{"type", "Fast"}}, kHeronCurve)),
                       "<dynamics>: <type> is 'Fast', expected ZeroOrder, FirstOrder, Yoerger, "
                       "Bessa"));
  EXPECT_TRUE(
      contains(refusal(heron_thruster({{"type", "FirstOrder"}}, kHeronCurve)), "<timeConstant>"));
  EXPECT_TRUE(contains(refusal(heron_thruster(kFirstOrder, {{"type", "LinearInterp"},
                                                            {"inputValues", "0 1 1"},
                                                            {"outputValues", "0 1 2"}})),
                       "<inputValues> is '1', expected numbers that rise"));
  EXPECT_TRUE(contains(refusal(heron_thruster(kFirstOrder, kHeronCurve, {{"clampMax", "-2"}})),
                       "<clampMax> is '-2'"));
  EXPECT_TRUE(contains(refusal(good, {{"submerged_height", "0"}}), "<submerged_height> is '0'"));
  EXPECT_TRUE(contains(refusal(good, {}, {{"type", "spheroid"}}), "<type> is 'spheroid'"));
  EXPECT_TRUE(contains(refusal(good, {}, {{"linear_damping", "1 0 0 0 0 0"}}),
                       "<linear_damping> is '1', expected numbers <= 0"));
  EXPECT_TRUE(contains(refusal(good, {}, {{"added_mass", "1 2 3"}}), "expected 36 numbers"));
  EXPECT_TRUE(contains(refusal(good, {}, {{"offset_added_mass", "-40"}}), "positive definite"));
}

}  // namespace
}  // namespace trident::sim
